// Sums of Beckmann lobes with height-correlated Smith masking and Schlick's Fresnel curve.
#include "builtin.h"

#include <cmath>
#include <numbers>

#include "error.h"
#include "microfacet.h"
#include "table_sampling.h"

namespace smx {

namespace {

Rgb two_layer(const Cosines &at) {
    constexpr double gloss_alpha = 0.06, gloss_f0 = 0.04, body_alpha = 0.6;
    constexpr Rgb body = {0.55, 0.10, 0.04};
    const double gloss = schlick(at.d, gloss_f0);
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c)
        f[c] = gloss * beckmann_lobe(at, gloss_alpha) + (1.0 - gloss) * body[c] * beckmann_lobe(at, body_alpha);
    return f;
}

Rgb conductor(const Cosines &at) {
    constexpr double alpha = 0.2;
    constexpr Rgb f0 = {0.95, 0.64, 0.54}; // copper's colour
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c) f[c] = schlick(at.d, f0[c]) * beckmann_lobe(at, alpha);
    return f;
}

// A mirror as sharp as the table's nodes hold: facets within a few thousandths of a radian. f cos reflects what it
// receives, f = g(theta_h) / (4 cos^2 theta_d), since both cosines are close to that of theta_d; the integral of g over
// half vectors, as the table is looked up between its nodes, is 1. (1 / cos^2 is convex and looked up linearly, which
// adds half a percent at 80 degrees, 0.1 at 70.)
double mirror_peak(std::size_t theta_h) {
    constexpr double width = 2e-3; // the nodes 0 to 4 are within it
    return std::exp(-std::pow(Brdf::theta_h(theta_h) / width, 2.0));
}

// Half vectors' integral of the peak, linear in sqrt(theta_h) between the nodes.
double mirror_mass() {
    constexpr std::size_t steps = 256; // of a cell, by midpoints
    double mass = 0.0;
    for (std::size_t k = 0; k + 1 < Brdf::theta_h_count; ++k)
        for (std::size_t j = 0; j < steps; ++j) {
            const double share = (static_cast<double>(j) + 0.5) / steps, row = static_cast<double>(k) + share;
            const double root = row / Brdf::theta_h_count, theta = root * root * std::numbers::pi / 2;
            const double dtheta = std::numbers::pi * root / (Brdf::theta_h_count * static_cast<double>(steps));
            const double peak = (1.0 - share) * mirror_peak(k) + share * mirror_peak(k + 1);
            mass += 2 * std::numbers::pi * std::sin(theta) * peak * dtheta;
        }
    return mass;
}

Brdf mirror(const std::string &name, const std::string &source) {
    const double scale = 1.0 / mirror_mass();
    return sample_table(name, source, [scale](std::size_t theta_h, std::size_t, const Cosines &at) {
        const double f = scale * mirror_peak(theta_h) / (4.0 * at.d * at.d);
        return Rgb{f, f, f};
    });
}

} // namespace

Brdf make_builtin(const std::string &name) {
    const std::string source = std::string(builtin_prefix) + name;
    if (name == "two-layer") return sample_table(name, source, two_layer);
    if (name == "conductor") return sample_table(name, source, conductor);
    if (name == "mirror") return mirror(name, source);
    fail(Fault::InvalidArgument, "no built-in material \"", name, "\"; there are two-layer, conductor and mirror");
}

} // namespace smx
