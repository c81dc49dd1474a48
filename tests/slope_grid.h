// Points of the slope plane that integrate what has a mixture's shape: midpoints of a grid over every lobe's own
// slopes, each point with its share by the balance heuristic, so that lobes of any ratio are integrated together.
#pragma once

#include <vector>

#include "oracle.h"

namespace test {

struct SlopePoint {
    double x, y;
    double weight; // of the integral over slopes
};

// n x n for each lobe, over 5 alphas, beyond which 3e-12 of the mass lies. Full rank.
inline std::vector<SlopePoint> slope_grid(const oracle::Mixture &m, int n) {
    constexpr double reach = 5.0;
    std::vector<oracle::Gaussian> lobes;
    for (const oracle::Lobe &lobe : m.lobes) lobes.push_back(oracle::widened(m.x, lobe.alpha));
    std::vector<SlopePoint> points;
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        // The covariance as a product of triangles turns the plane's grid into the lobe's.
        const oracle::Gaussian &g = lobes[k];
        const double a = std::sqrt(2.0 * g.cov_xx), b = 2.0 * g.cov_xy / a;
        const double c = std::sqrt(2.0 * (g.cov_xx * g.cov_yy - g.cov_xy * g.cov_xy) / g.cov_xx);
        const double step = 2.0 * reach / n;
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column) {
                const double u = (row + 0.5) * step - reach, v = (column + 0.5) * step - reach;
                const double x = g.mean_x + a * u, y = g.mean_y + b * u + c * v;
                double all = 0.0;
                for (std::size_t j = 0; j < lobes.size(); ++j) all += m.lobes[j].weight * oracle::p22(lobes[j], x, y);
                const double own = m.lobes[k].weight * oracle::p22(g, x, y);
                if (own > 0.0) points.push_back({x, y, step * step * a * c * own / all});
            }
    }
    return points;
}

} // namespace test
