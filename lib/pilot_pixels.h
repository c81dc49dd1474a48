// Some pixels that stand for an image in sums over it: drawn without replacement, the bright ones more often, each with
// the inverse of its probability as its weight.
#pragma once

#include <functional>

#include "image.h"
#include "scene.h"

namespace smx {

// Directions in the pixels' frames, packed [count][3].
struct PilotPixels {
    std::vector<float> wi, wo;
    std::vector<double> weight; // pixels of the image that each stands for, up to a common factor
    std::size_t count() const { return weight.size(); }
};

// About `wanted` lit pixels, or all where there are no more of them: the sums are then the image's own. Brightness is
// asked for once, as an image of the scene at no more than 128 pixels across: larger scenes are drawn from in square
// blocks, of which it shows one pixel each.
PilotPixels pilot_pixels(const Scene &scene, std::size_t wanted,
                         const std::function<Image(const Scene &scene)> &brightness);

} // namespace smx
