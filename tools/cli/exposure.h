// The exposure of display images: what counts as bright in a rendering, and the factor that takes it to 0.9.
#pragma once

#include "handles.h"

namespace slopemix::cli {

inline constexpr double bright_quantile = 0.99;
inline constexpr double bright_display = 0.9; // linear, before the sRGB transfer

// The 99th percentile of the image's values; its maximum where that is 0 (a highlight of a few pixels on black).
inline double bright_value(const Image &image) {
    double value = 0.0;
    check(smx_image_quantile(image.get(), bright_quantile, &value));
    if (value <= 0.0) check(smx_image_quantile(image.get(), 1.0, &value));
    return value;
}

// 1 for a black image, on which the exposure has no effect.
inline double exposure_for(double bright) { return bright > 0.0 ? bright_display / bright : 1.0; }

} // namespace slopemix::cli
