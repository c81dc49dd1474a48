// Fresnel curves as the fit sees them: quadratic B-splines over theta_d with non-negative coefficients, so that a curve
// is smooth and cannot be negative, and the model stays linear in them (de Boor 1978, "A Practical Guide to Splines").
// Breakpoints are denser towards grazing, where curves bend. (Piecewise linear curves on as many knots are off by 5 %
// between two of them on a dielectric at theta_d = 57.5 degrees.)
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "material.h"

namespace smx {

// The three coefficients that make the curve at an angle 0..pi/2, and their weights, which sum to 1.
struct CurveShares {
    std::size_t first;
    std::array<double, 3> weight;
};
CurveShares curve_shares(double theta_d);

// Angles at whole degrees at which data tell the coefficients apart: breakpoints and the middles between them.
std::vector<double> curve_levels();

// Coefficients to values at the given angles.
std::vector<double> curve_values(const std::vector<double> &coefficients, const std::vector<double> &theta_d);

// Weight of the curves' roughness, the squared second differences of their coefficients, beside the data.
constexpr double smoothness = 1e-5;

} // namespace smx
