#include "table_slice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smx {

namespace {

// Table rows around theta_d and the share of the upper one. Nearest takes the cell that holds the angle.
struct Cut {
    std::size_t lower, upper;
    double share;
};

Cut cut_at(double theta_d, Lookup lookup) {
    const double knot = theta_d / (std::numbers::pi / 2) * Brdf::theta_d_count;
    const auto below = std::min(static_cast<std::size_t>(knot), Brdf::theta_d_count - 1);
    const auto above = std::min(below + 1, Brdf::theta_d_count - 1);
    return {below, above, lookup == Lookup::Nearest ? 0.0 : knot - static_cast<double>(below)};
}

} // namespace

double folded(const Brdf &brdf, std::size_t channel, std::size_t h, std::size_t d, std::size_t column) {
    double sum = 0.0, count = 0.0;
    for (std::size_t p = column; p < brdf.phi_d_count(); p += slice_columns, ++count)
        sum += brdf.value(channel, brdf.cell(h, d, p));
    return sum / count;
}

std::vector<float> table_slice(const Brdf &brdf, double theta_d, Lookup lookup) {
    const Cut cut = cut_at(theta_d, lookup);
    std::vector<float> slice;
    slice.reserve(4 * Brdf::theta_h_count * (slice_columns + 1));
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t column = 0; column <= slice_columns; ++column) {
            for (std::size_t c = 0; c < 3; ++c)
                slice.push_back(
                    static_cast<float>(std::lerp(folded(brdf, c, h, cut.lower, column % slice_columns),
                                                 folded(brdf, c, h, cut.upper, column % slice_columns), cut.share)));
            slice.push_back(0.0f);
        }
    return slice;
}

} // namespace smx
