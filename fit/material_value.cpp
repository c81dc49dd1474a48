#include "material_value.h"

#include <cmath>
#include <numbers>

#include "microfacet.h"

namespace smx {

namespace {

Rgb shared_value(const std::vector<Lobe> &lobes, const std::vector<double> &ndf, const Rgb &fresnel,
                 const Cosines &at) {
    double mixed_ndf = 0.0, sigma_i = 0.0, sigma_o = 0.0;
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        const auto [weight, alpha] = lobes[k];
        mixed_ndf += weight * ndf[k];
        sigma_i += weight * beckmann_sigma(at.i, alpha);
        sigma_o += weight * beckmann_sigma(at.o, alpha);
    }
    const double value = smith_lobe(at, mixed_ndf, sigma_i, sigma_o);
    return {fresnel[0] * value, fresnel[1] * value, fresnel[2] * value};
}

Rgb per_lobe_value(const std::vector<Lobe> &lobes, const std::vector<double> &ndf, const std::vector<Rgb> &fresnel,
                   const Cosines &at) {
    Rgb f{};
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        if (ndf[k] == 0.0) continue; // far out on a sharp lobe
        const double alpha = lobes[k].alpha;
        const double value = smith_lobe(at, ndf[k], beckmann_sigma(at.i, alpha), beckmann_sigma(at.o, alpha));
        for (std::size_t c = 0; c < 3; ++c) f[c] += fresnel[k][c] * value;
    }
    return f;
}

// From each lobe's distribution at the half vector and the sets of curves at theta_d.
Rgb value(Model model, const std::vector<Lobe> &lobes, const std::vector<double> &ndf, const std::vector<Rgb> &fresnel,
          const Cosines &at) {
    return model == Model::Shared ? shared_value(lobes, ndf, fresnel[0], at) : per_lobe_value(lobes, ndf, fresnel, at);
}

std::vector<Rgb> fresnel_sets(const Material &m, double theta_d) {
    std::vector<Rgb> sets;
    for (const FresnelCurves &set : m.fresnel) sets.push_back(fresnel_at(m.theta_d, set, theta_d));
    return sets;
}

} // namespace

MaterialValue::MaterialValue(const Material &m) : model_(m.model), lobes_(m.lobes) {
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h) {
        ndf_.emplace_back();
        for (const Lobe &lobe : lobes_) ndf_[h].push_back(beckmann_ndf(std::cos(Brdf::theta_h(h)), lobe.alpha));
    }
    for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) fresnel_.push_back(fresnel_sets(m, Brdf::theta_d(d)));
}

Rgb MaterialValue::operator()(std::size_t h, std::size_t d, const Cosines &at) const {
    return value(model_, lobes_, ndf_[h], fresnel_[d], at);
}

MaterialAtLevel::MaterialAtLevel(const Material &m, double theta_d, double displacement2)
    : model_(m.model), cos_d_(std::cos(theta_d)), widened_(m.lobes), fresnel_(fresnel_sets(m, theta_d)) {
    for (Lobe &lobe : widened_) lobe.alpha = std::sqrt(lobe.alpha * lobe.alpha + displacement2);
}

Rgb MaterialAtLevel::operator()(const DirectionSample &s) const {
    std::vector<double> ndf;
    for (const Lobe &lobe : widened_) {
        const double alpha2 = lobe.alpha * lobe.alpha;
        ndf.push_back(std::exp(-s.tan2 / alpha2) * s.inv_cos4 / (std::numbers::pi * alpha2));
    }
    return value(model_, widened_, ndf, fresnel_, {s.ci, s.co, 1.0 / std::sqrt(1.0 + s.tan2), cos_d_});
}

} // namespace smx
