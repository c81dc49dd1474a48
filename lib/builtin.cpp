// Sums of Beckmann lobes with height-correlated Smith masking (DESIGN's formulas; here in double on the table's nodes,
// the device's form is in cl/beckmann.clh).
#include "builtin.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "error.h"
#include "merl_file.h"
#include "sha256.h"

namespace smx {

namespace {

// A direction pair of the table, in the cosines that isotropic lobes need.
struct Angles {
    double cos_i, cos_o, cos_h, cos_d;
};

double sigma(double cos_theta, double alpha) {
    const double s = alpha * std::sqrt(1.0 - cos_theta * cos_theta);
    if (s == 0.0) return cos_theta;
    const double v = cos_theta / s;
    return cos_theta * std::erfc(-v) / 2 + s * std::exp(-v * v) / (2 * std::sqrt(std::numbers::pi));
}

// D G2 / (4 cos_i cos_o).
double lobe(const Angles &a, double alpha) {
    const double cos2 = a.cos_h * a.cos_h, tan2 = (1.0 - cos2) / cos2;
    const double ndf = std::exp(-tan2 / (alpha * alpha)) / (std::numbers::pi * alpha * alpha * cos2 * cos2);
    return ndf / (4 * (sigma(a.cos_i, alpha) * a.cos_o + sigma(a.cos_o, alpha) * a.cos_i - a.cos_i * a.cos_o));
}

// Schlick 1994.
double fresnel(double cos_d, double f0) { return f0 + (1.0 - f0) * std::pow(1.0 - cos_d, 5); }

Rgb two_layer(const Angles &a) {
    constexpr double gloss_alpha = 0.06, gloss_f0 = 0.04, body_alpha = 0.6;
    constexpr Rgb body = {0.55, 0.10, 0.04};
    const double gloss = fresnel(a.cos_d, gloss_f0);
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c)
        f[c] = gloss * lobe(a, gloss_alpha) + (1.0 - gloss) * body[c] * lobe(a, body_alpha);
    return f;
}

Rgb conductor(const Angles &a) {
    constexpr double alpha = 0.2;
    constexpr Rgb f0 = {0.95, 0.64, 0.54}; // copper's colour
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c) f[c] = fresnel(a.cos_d, f0[c]) * lobe(a, alpha);
    return f;
}

Angles node_angles(std::size_t h, std::size_t d, double phi_d) {
    const double th = Brdf::theta_h(h), td = Brdf::theta_d(d);
    const double cos_cos = std::cos(th) * std::cos(td), sin_sin = std::sin(th) * std::sin(td) * std::cos(phi_d);
    return {cos_cos - sin_sin, cos_cos + sin_sin, std::cos(th), std::cos(td)};
}

template <typename Model>
std::vector<double> sample(std::size_t phi_d_count, Model model) {
    const std::size_t cells = Brdf::theta_h_count * Brdf::theta_d_count * phi_d_count;
    std::vector<double> values(3 * cells, -1.0);
    for (std::size_t h = 0, cell = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t d = 0; d < Brdf::theta_d_count; ++d)
            for (std::size_t p = 0; p < phi_d_count; ++p, ++cell) {
                const Angles a = node_angles(h, d, static_cast<double>(p) * std::numbers::pi / 180);
                if (a.cos_i <= 0.0 || a.cos_o <= 0.0) continue;
                const Rgb f = model(a);
                for (std::size_t c = 0; c < 3; ++c) values[c * cells + cell] = f[c];
            }
    return values;
}

} // namespace

Brdf make_builtin(const std::string &name) {
    constexpr std::size_t phi_d_count = 180;
    std::vector<double> values;
    if (name == "two-layer")
        values = sample(phi_d_count, two_layer);
    else if (name == "conductor")
        values = sample(phi_d_count, conductor);
    else
        fail(Fault::InvalidArgument, "no built-in material \"", name, "\"; there are two-layer and conductor");
    const std::string hash = sha256_hex(merl_bytes(phi_d_count, values));
    return Brdf(name, std::string(builtin_prefix) + name, hash, phi_d_count, std::move(values));
}

} // namespace smx
