#include "curve_basis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smx {

namespace {

constexpr double degree = std::numbers::pi / 180;

// Ends tripled: a clamped knot vector.
constexpr std::array<double, curve_coefficients + 3> knots = {0,  0,  0,  12, 25, 37, 48, 57,
                                                              65, 72, 78, 83, 87, 90, 90, 90};

} // namespace

CurveShares curve_shares(double theta_d) {
    const double x = std::clamp(theta_d / degree, 0.0, 90.0);
    const auto above = std::upper_bound(knots.begin() + 3, knots.end() - 3, x);
    const auto j = static_cast<std::size_t>(above - knots.begin()) - 1; // knots[j] <= x <= knots[j + 1]

    // Linear splines over the interval, then quadratic ones: Cox-de Boor.
    const double r = (x - knots[j]) / (knots[j + 1] - knots[j]);
    const double a = (x - knots[j - 1]) / (knots[j + 1] - knots[j - 1]);
    const double b = (x - knots[j]) / (knots[j + 2] - knots[j]);
    return {j - 2, {(1 - r) * (1 - a), (1 - r) * a + r * (1 - b), r * b}};
}

std::vector<double> curve_levels() {
    std::vector<double> levels;
    for (std::size_t j = 2; j + 3 < knots.size(); ++j) {
        levels.push_back(knots[j] * degree);
        levels.push_back(std::floor((knots[j] + knots[j + 1]) / 2) * degree);
    }
    return levels;
}

std::vector<double> curve_values(const std::vector<double> &coefficients, const std::vector<double> &theta_d) {
    std::vector<double> values;
    for (double angle : theta_d) {
        const auto [first, weight] = curve_shares(angle);
        double value = 0.0;
        for (std::size_t a = 0; a < 3; ++a) value += weight[a] * coefficients[first + a];
        values.push_back(value);
    }
    return values;
}

} // namespace smx
