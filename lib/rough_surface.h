// Lobes widened by X in closed form, on the host in double, for what is judged before an image is rendered. The
// device's form is in cl/mixture.clh.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "even_points.h"
#include "scene.h"

namespace smx {

using Direction3 = std::array<double, 3>;

// Projected area of a Beckmann surface beyond the mean plane's p, s^2 = 2 k_t' Cov k_t (cl/beckmann.clh).
inline double sigma_beyond_p(double p, double s2) {
    const double s = std::sqrt(s2);
    if (p >= 6.0 * s) return 0.0; // below a rounding of p: exp(-36) s
    const double v = p / s;
    return 0.5 * s * (std::numbers::inv_sqrtpi * std::exp(-v * v) - v * std::erfc(v));
}

class RoughSurface {
  public:
    explicit RoughSurface(const Displacement &x) : x_(x), axes_(principal_axes(x)) {}

    double mean_plane(const Direction3 &k) const { return k[2] - k[0] * x_.mean_slope_x - k[1] * x_.mean_slope_y; }

    // Squared alphas of a lobe along the principal axes.
    double var_1(double alpha2) const { return alpha2 + axes_.var_1; }
    double var_2(double alpha2) const { return alpha2 + axes_.var_2; }

    // s^2 of a lobe towards k.
    double s2(double alpha2, const Direction3 &k) const {
        const double k1 = axes_.axis_x * k[0] + axes_.axis_y * k[1], k2 = axes_.axis_x * k[1] - axes_.axis_y * k[0];
        return k1 * k1 * var_1(alpha2) + k2 * k2 * var_2(alpha2);
    }

    // Density of slopes.
    double p22(double alpha2, double slope_x, double slope_y) const {
        const double dx = slope_x - x_.mean_slope_x, dy = slope_y - x_.mean_slope_y;
        const double d1 = axes_.axis_x * dx + axes_.axis_y * dy, d2 = axes_.axis_x * dy - axes_.axis_y * dx;
        return std::exp(-d1 * d1 / var_1(alpha2) - d2 * d2 / var_2(alpha2)) /
               (std::numbers::pi * std::sqrt(var_1(alpha2) * var_2(alpha2)));
    }

    // A slope of the lobe, from a point of the unit square (Box and Muller 1958).
    Point2 slope(double alpha2, const Point2 &u) const {
        const double radius = std::sqrt(-std::log1p(-u.x)), turn = 2 * std::numbers::pi * u.y;
        const double d1 = radius * std::cos(turn) * std::sqrt(var_1(alpha2));
        const double d2 = radius * std::sin(turn) * std::sqrt(var_2(alpha2));
        return {x_.mean_slope_x + axes_.axis_x * d1 - axes_.axis_y * d2,
                x_.mean_slope_y + axes_.axis_y * d1 + axes_.axis_x * d2};
    }

  private:
    Displacement x_;
    PrincipalAxes axes_;
};

// Share of the light from X's facets towards wo that meets another facet on its way, were they mirrors: what single
// scattering loses.
double lost_energy(const RoughSurface &x, const Direction3 &wo);

} // namespace smx
