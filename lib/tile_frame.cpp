#include "tile_frame.h"

#include <cmath>

namespace smx {

TileFrame tile_frame(const HeightField &field, const Displacement &displacement) {
    // A = K^(-1/2) B, with K the covariance of the tile's slopes, of 1 and c, and B' B that of X.
    const double c = facet_correlation(field.log2_side);
    const double sum = 1.0 / std::sqrt(1.0 + c), difference = 1.0 / std::sqrt(1.0 - c);
    const double same = (sum + difference) / 2, other = (sum - difference) / 2;
    const PrincipalAxes x = principal_axes(displacement);
    const double alpha_1 = std::sqrt(x.var_1), alpha_2 = std::sqrt(x.var_2);
    const double b_1x = alpha_1 * x.axis_x, b_1y = alpha_1 * x.axis_y, b_2x = -alpha_2 * x.axis_y,
                 b_2y = alpha_2 * x.axis_x;
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(same * b_1x + other * b_2x),
            f(same * b_1y + other * b_2y),
            f(other * b_1x + same * b_2x),
            f(other * b_1y + same * b_2y),
            f(displacement.mean_slope_x),
            f(displacement.mean_slope_y),
            field.top,
            static_cast<std::int32_t>(field.log2_side)};
}

} // namespace smx
