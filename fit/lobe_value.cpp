#include "lobe_value.h"

#include <cmath>
#include <numbers>

namespace smx {

namespace {

// sigma(k) and its derivative by s = alpha sin(theta), which is exp(-v^2) / (2 sqrt(pi)).
struct Sigma {
    double value, by_s;
};

Sigma sigma(double cosine, double s) {
    constexpr double half_inv_sqrt_pi = 0.5 * std::numbers::inv_sqrtpi;
    if (cosine >= 6.0 * s) return {cosine, 0.0}; // the rest is below a rounding of the cosine: exp(-36) s
    const double v = cosine / s, gauss = std::exp(-v * v) * half_inv_sqrt_pi;
    return {cosine * std::erfc(-v) / 2 + s * gauss, gauss};
}

} // namespace

LobeValue lobe_value(const DirectionSample &d, double base_alpha) {
    const double alpha2 = base_alpha * base_alpha + d.displacement2, alpha = std::sqrt(alpha2);
    const double chain = base_alpha * base_alpha / alpha2;
    const double inv_alpha2 = 1.0 / alpha2, exponent = d.tan2 * inv_alpha2;
    const double ndf = std::exp(-exponent) * inv_alpha2 * std::numbers::inv_pi * d.inv_cos4;
    if (ndf == 0.0) return {0.0, 0.0};
    const double s_i = alpha * d.sin_i, s_o = alpha * d.sin_o;
    const Sigma i = sigma(d.ci, s_i), o = sigma(d.co, s_o);
    const double denominator = i.value * d.co + o.value * d.ci - d.ci * d.co;
    const double value = ndf / (4 * denominator);
    const double denominator_slope = i.by_s * s_i * d.co + o.by_s * s_o * d.ci;
    return {value, value * chain * (2 * exponent - 2 - denominator_slope / denominator)};
}

} // namespace smx
