// What the device should say of a pair of directions (hard_cases.h): every number by the oracle, in any arithmetic, and
// its condition number.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hard_cases.h"
#include "oracle_formulas.h"

namespace test {

// In the order of the probe (hard_probe.cpp). Shading is f cos of red, green, blue, without Fresnel's part in
// `geometry`.
enum Quantity : std::size_t {
    quantity_ndf,
    quantity_sigma,
    quantity_lambda,
    quantity_g1,
    quantity_theta_d,
    quantity_fresnel,                         // of three channels
    quantity_g2 = quantity_fresnel + 3,       // correlated, separable
    quantity_shared = quantity_g2 + 2,        // correlated and separable, of three channels
    quantity_per_lobe = quantity_shared + 6,  // likewise
    quantity_density = quantity_per_lobe + 6, // of drawing wi from wo: by the shared model, by lobes of weight 1 each
    quantity_less = quantity_density + 2,     // f cos, shared, red: without masking, without shadowing, without either
    quantities = quantity_less + 3
};
const std::vector<std::string> &quantity_names();

inline bool has_fresnel(std::size_t quantity) {
    return (quantity >= quantity_fresnel && quantity < quantity_g2) ||
           (quantity >= quantity_shared && quantity < quantity_density) || quantity >= quantity_less;
}

// Of the curve that ends at 0.
inline bool has_steep_fresnel(std::size_t quantity) {
    if (quantity < quantity_fresnel || quantity >= quantity_density) return false;
    return quantity < quantity_g2 ? quantity == quantity_fresnel + 2
                                  : quantity >= quantity_shared && (quantity - quantity_shared) % 3 == 2;
}

// Where a number has no value to compare with: Lambda at the horizon, theta_d below it.
constexpr double no_value = -1.0;

template <class T>
struct CaseOf {
    oracle::GaussianOf<T> x;
    std::vector<T> weight, alpha;
    std::vector<oracle::GaussianOf<T>> widened;
    std::vector<bool> has_density;
    std::array<T, hard_knots> knots;
    const HardCase *of; // its curves
};

// What makes inputs: of plain numbers, and of those that carry derivatives.
template <class T>
inline constexpr auto constant_of = [](double value, std::size_t) { return T(value); };
template <class Dual>
inline constexpr auto variable_of = [](double value, std::size_t index) { return Dual::variable(value, index); };

// `variable(value, number)` makes the inputs: 0..2 wi, 3..5 wo, 6..10 X, 11 all alphas together, 12 all knots together.
// (The condition of a sum over lobes by each of their alphas and weights is larger: this one is the stricter.)
inline constexpr std::size_t hard_variables = 13;

template <class T, class Variable>
CaseOf<T> case_of(const HardCase &c, Variable variable) {
    CaseOf<T> out;
    out.of = &c;
    out.x = oracle::gaussian_of<T>(variable(c.x.alpha_x, 6), variable(c.x.alpha_y, 7), variable(c.x.rho, 8),
                                   variable(c.x.mean_x, 9), variable(c.x.mean_y, 10));
    const bool is_plane = c.x.alpha_x > 0.0 && c.x.alpha_y > 0.0;
    for (const oracle::Lobe &lobe : c.lobes) {
        out.weight.push_back(T(lobe.weight));
        out.alpha.push_back(variable(lobe.alpha, 11));
        out.widened.push_back(oracle::widened_by(out.x, out.alpha.back()));
        out.has_density.push_back(lobe.alpha > 0.0 || is_plane);
    }
    const HardCurve knots = hard_theta_d(c);
    for (std::size_t k = 0; k < hard_knots; ++k) out.knots[k] = variable(static_cast<double>(knots[k]), 12);
    return out;
}

template <class T, class Variable>
oracle::VecOf<T> direction_of(const std::array<float, 3> &k, std::size_t first, Variable variable) {
    return {variable(static_cast<double>(k[0]), first), variable(static_cast<double>(k[1]), first + 1),
            variable(static_cast<double>(k[2]), first + 2)};
}

template <class T>
T linear_between_knots(const CaseOf<T> &c, std::size_t set, std::size_t channel, const T &angle) {
    std::size_t k = 0;
    while (k + 2 < hard_knots && !(angle < c.knots[k + 1])) ++k;
    const HardCurve curve = hard_curve(*c.of, set, channel);
    const T share = (angle - c.knots[k]) / (c.knots[k + 1] - c.knots[k]);
    return T(static_cast<double>(curve[k])) * (T(1.0) - share) + T(static_cast<double>(curve[k + 1])) * share;
}

// Whether an angle that is off by `error` may be on the other side of a knot, where the curve's slope is another.
inline bool is_near_knot(const HardCase &c, double angle, double error) {
    const HardCurve knots = hard_theta_d(c);
    for (std::size_t k = 1; k + 1 < hard_knots; ++k)
        if (std::abs(angle - static_cast<double>(knots[k])) <= error) return true;
    return false;
}

// Whether the exponent of some lobe's density, 16 epsilon of its condition off, is one of a density that a float holds.
template <class Dual>
bool may_have_density(const CaseOf<Dual> &c, const oracle::VecOf<Dual> &h, double epsilon) {
    constexpr double least = 145.0; // of exponents: 2^-206.5, where the device's densities end
    if (!(0.0 < h.z.value)) return false;
    const Dual none(0.0), x = none - h.x / h.z, y = none - h.y / h.z;
    for (std::size_t k = 0; k < c.widened.size(); ++k) {
        if (!c.has_density[k]) continue;
        const Dual exponent = oracle::exponent(c.widened[k], x, y);
        if (exponent.value * (1.0 - 16 * epsilon * exponent.condition()) < least) return true;
    }
    return false;
}

// How much a density about a mean slope may change by the second derivative of its exponent, which is what counts at
// its peak, where slopes are off by 4 epsilon of their terms. (About 0 they are off by a share of themselves, which the
// condition number knows.)
inline double second_order(const HardCase &c, const HardPair &pair, double epsilon) {
    if (c.x.mean_x == 0.0 && c.x.mean_y == 0.0) return 0.0;
    const double z = static_cast<double>(pair.wi[2]) + pair.wo[2];
    const double x = (static_cast<double>(pair.wi[0]) + pair.wo[0]) / z;
    const double y = (static_cast<double>(pair.wi[1]) + pair.wo[1]) / z;
    const double off = 4 * epsilon * (std::hypot(x, y) + std::hypot(c.x.mean_x, c.x.mean_y));
    double most = 0.0;
    for (const oracle::Lobe &lobe : c.lobes) {
        const double a2 = lobe.alpha * lobe.alpha, xx = c.x.alpha_x * c.x.alpha_x, yy = c.x.alpha_y * c.x.alpha_y;
        const double determinant = xx * yy * (1.0 - c.x.rho * c.x.rho) + a2 * (xx + yy + a2);
        if (determinant > 0.0) most = std::max(most, off * off * (xx + yy + 2 * a2) / determinant);
    }
    return most;
}

// A mean plane seen so nearly edge on that rounding decides whether it is seen: no sign is right or wrong.
inline bool is_sign_open(const HardCase &c, const std::array<float, 3> &k, double epsilon) {
    const double x = std::abs(k[0] * c.x.mean_x), y = std::abs(k[1] * c.x.mean_y), z = std::abs(k[2]);
    return x + y > 0.0 && std::abs(k[2] - k[0] * c.x.mean_x - k[1] * c.x.mean_y) <= 4 * epsilon * (x + y + z);
}

// A direction so low over a surface that is a mirror along an axis that the slope's spread seen from there, squared, is
// below a float's range: s below 2^-63 counts as 0 (cl/beckmann.clh).
inline bool is_spread_lost(const HardCase &c, const std::array<float, 3> &k) {
    if (c.x.alpha_x > 0.0 && c.x.alpha_y > 0.0) return false;
    bool has_mirror = false;
    for (const oracle::Lobe &lobe : c.lobes) has_mirror = has_mirror || lobe.alpha == 0.0;
    return has_mirror && k[2] > 0.0f && k[2] < 1e-17f;
}

// Every quantity of one pair.
template <class T>
std::array<T, quantities> truth_of(const CaseOf<T> &c, const oracle::VecOf<T> &wi, const oracle::VecOf<T> &wo) {
    const T none(0.0);
    std::array<T, quantities> q;
    q.fill(none);
    const oracle::VecOf<T> h = wi + wo;
    const T p_i = oracle::plane(c.x, wi), p_o = oracle::plane(c.x, wo);
    const bool up_i = none < p_i, sees = none < p_o && none < wo.z, visible = up_i && sees && none < wi.z;
    const std::size_t lobes = c.weight.size();

    std::vector<T> ndf(lobes, none), sigma_i(lobes, none), sigma_o(lobes, none);
    T sum_ndf = none, sum_i = none, sum_o = none, beyond = none;
    for (std::size_t k = 0; k < lobes; ++k) {
        if (c.has_density[k] && none < h.z) ndf[k] = oracle::ndf(c.widened[k], h);
        sum_ndf = sum_ndf + c.weight[k] * ndf[k];
        if (!(p_i < none)) {
            sigma_i[k] = oracle::sigma(c.widened[k], wi);
            sum_i = sum_i + c.weight[k] * sigma_i[k];
            beyond = beyond + c.weight[k] * oracle::beyond_plane(c.widened[k], wi);
        }
        if (sees) {
            sigma_o[k] = oracle::sigma(c.widened[k], wo);
            sum_o = sum_o + c.weight[k] * sigma_o[k];
        }
    }
    q[quantity_ndf] = sum_ndf;
    q[quantity_sigma] = p_i < none ? T(no_value) : sum_i;
    q[quantity_lambda] = up_i ? beyond / p_i : T(no_value);
    q[quantity_g1] = up_i ? p_i / sum_i : none;
    if (sees) {
        q[quantity_density] = sum_ndf / (T(4.0) * sum_o);
        for (std::size_t k = 0; k < lobes; ++k)
            q[quantity_density + 1] = q[quantity_density + 1] + ndf[k] / (T(4.0) * sigma_o[k]);
    }
    if (!visible) {
        q[quantity_theta_d] = T(no_value);
        for (std::size_t channel = 0; channel < 3; ++channel) q[quantity_fresnel + channel] = T(no_value);
        return q;
    }

    const T angle = oracle::difference_angle(wi, wo), quarter = T(0.25) / p_o;
    q[quantity_theta_d] = angle;
    q[quantity_g2] = oracle::g2_correlated(p_i, sum_i, p_o, sum_o);
    q[quantity_g2 + 1] = oracle::g2_separable(p_i, sum_i, p_o, sum_o);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const T f = linear_between_knots(c, 0, channel, angle);
        q[quantity_fresnel + channel] = f;
        for (std::size_t g = 0; g < 2; ++g)
            q[quantity_shared + 3 * g + channel] = f * sum_ndf * q[quantity_g2 + g] * quarter;
    }
    // Without masking f cos goes like 1 / p_o, which is held at 1e-14.
    const T held(static_cast<double>(1e-14f)), seen = p_o < held ? held : p_o, lit = q[quantity_fresnel] * sum_ndf;
    q[quantity_less] = lit / (T(4.0) * (seen + beyond * p_o / p_i));
    q[quantity_less + 1] = lit / (T(4.0) * sum_o);
    q[quantity_less + 2] = lit / (T(4.0) * seen);
    for (std::size_t k = 0; k < lobes; ++k) {
        const T by_masking[2] = {ndf[k] * oracle::g2_correlated(p_i, sigma_i[k], p_o, sigma_o[k]) * quarter,
                                 ndf[k] * oracle::g2_separable(p_i, sigma_i[k], p_o, sigma_o[k]) * quarter};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const T f = linear_between_knots(c, k, channel, angle);
            for (std::size_t g = 0; g < 2; ++g)
                q[quantity_per_lobe + 3 * g + channel] = q[quantity_per_lobe + 3 * g + channel] + f * by_masking[g];
        }
    }
    return q;
}

} // namespace test
