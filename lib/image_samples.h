// Pixels of an image to judge it by, without rendering it.
#pragma once

#include <vector>

#include "material.h"
#include "scene.h"

namespace smx {

struct ImageSample {
    LocalDirections d;
    double weight; // of the sum over the image's lit pixels that stands for the whole
};

// Lit pixels: all of a small image's; of others some spread over the disc, and some about the highlight of each lobe,
// widened by X, joined by the balance heuristic. They are pixels' centres, so that a highlight between them is missed
// here as there. Empty where nothing is lit.
std::vector<ImageSample> image_samples(const Material &material, const Scene &scene);

// Change of a facet's slope from pixel to pixel about a highlight; the more, the more at a slant the sphere is seen
// there.
double pixel_slope(const Scene &scene);

} // namespace smx
