// The facets of the geometric reference's tiles, as the host knows them.
#pragma once

#include <cmath>
#include <functional>

#include "height_fields.h"
#include "tile_frame.h"

namespace test {

// The slopes of all facets of a field on a surface.
inline void visit_facets(const smx::HeightField &f, const smx::Displacement &x,
                         const std::function<void(double sx, double sy)> &visit) {
    const smx::TileFrame a = smx::tile_frame(f, x);
    const std::size_t side = f.side();
    const auto height = [&](std::size_t i, std::size_t j) { return double{f.heights[j % side * side + i % side]}; };
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i)
            for (std::size_t upper : {0u, 1u}) {
                const double gx = height(i + 1, j + upper) - height(i, j + upper),
                             gy = height(i + upper, j + 1) - height(i + upper, j);
                visit(a.a_xx * gx + a.a_yx * gy + a.mean_x, a.a_xy * gx + a.a_yy * gy + a.mean_y);
            }
}

// X with the covariance that its facets have in realisations 0, 1, ..., `count` - 1 of a seed.
inline smx::Displacement measured(const smx::Displacement &x, std::uint32_t log2_side, std::uint64_t seed,
                                  std::uint32_t count) {
    smx::HeightFields fields(log2_side, seed);
    double xx = 0.0, xy = 0.0, yy = 0.0, n = 0.0;
    for (std::uint32_t r = 0; r < count; ++r)
        visit_facets(*fields.get(r), x, [&](double sx, double sy) {
            const double u = sx - x.mean_slope_x, v = sy - x.mean_slope_y;
            xx += u * u, xy += u * v, yy += v * v, ++n;
        });
    const double rho = xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
    return {std::sqrt(2.0 * xx / n), std::sqrt(2.0 * yy / n), rho, x.mean_slope_x, x.mean_slope_y};
}

} // namespace test
