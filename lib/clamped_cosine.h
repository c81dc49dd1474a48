// An integral that the inversion and the Fresnel fit share.
#pragma once

#include <cmath>
#include <numbers>

namespace smx {

// Integral over the azimuth of h of <o,h>+, in closed form, from the products of the cosines and of the sines of the
// two polar angles.
inline double clamped_cosine_ring(double cos_cos, double sin_sin) {
    if (cos_cos >= sin_sin) return 2 * std::numbers::pi * cos_cos;
    const double edge = std::acos(-cos_cos / sin_sin);
    return 2 * (edge * cos_cos + sin_sin * std::sin(edge));
}

} // namespace smx
