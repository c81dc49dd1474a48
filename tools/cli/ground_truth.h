// A converged reference that knows its own error: the mean of two, from independent scrambles.
#pragma once

#include <cstdint>

#include "handles.h"
#include "progress.h"

namespace slopemix::cli {

struct GroundTruth {
    Image image;
    std::uint32_t samples = 0; // per pixel, of each of the two
    double error = 0.0;        // standard error, relative to rms: the larger of what the two say of themselves and of
                               //   what their difference says
    double agreement = 0.0;    // their difference over its expectation, about 1; 0 where both are exact
    double rms = 0.0;          // of the image's values
    double peak = 0.0;         // its largest value
};

// `options` have the number of samples. Throws CommandError for a black image, `what` being its name: it has no
// relative error.
GroundTruth ground_truth(const Context &context, const Brdf &brdf, const smx_scene &scene,
                         const smx_render_options &options, const std::string &what);

// rms and peak of an image; throws as ground_truth() does.
void measure_scale(GroundTruth &truth, const std::string &what);

smx_comparison compare(const Image &image, const Image &reference);

} // namespace slopemix::cli
