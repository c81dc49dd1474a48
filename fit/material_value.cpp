#include "material_value.h"

#include <cmath>

#include "microfacet.h"

namespace smx {

MaterialValue::MaterialValue(const Material &m) : model_(m.model), lobes_(m.lobes) {
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h) {
        ndf_.emplace_back();
        for (const Lobe &lobe : lobes_) ndf_[h].push_back(beckmann_ndf(std::cos(Brdf::theta_h(h)), lobe.alpha));
    }
    for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) {
        fresnel_.emplace_back();
        for (const FresnelCurves &set : m.fresnel) fresnel_[d].push_back(fresnel_at(m.theta_d, set, Brdf::theta_d(d)));
    }
}

Rgb MaterialValue::operator()(std::size_t h, std::size_t d, const Cosines &at) const {
    return model_ == Model::Shared ? shared(h, d, at) : per_lobe(h, d, at);
}

Rgb MaterialValue::shared(std::size_t h, std::size_t d, const Cosines &at) const {
    double ndf = 0.0, sigma_i = 0.0, sigma_o = 0.0;
    for (std::size_t k = 0; k < lobes_.size(); ++k) {
        const auto [weight, alpha] = lobes_[k];
        ndf += weight * ndf_[h][k];
        sigma_i += weight * beckmann_sigma(at.i, alpha);
        sigma_o += weight * beckmann_sigma(at.o, alpha);
    }
    const double value = smith_lobe(at, ndf, sigma_i, sigma_o);
    const Rgb &fresnel = fresnel_[d][0];
    return {fresnel[0] * value, fresnel[1] * value, fresnel[2] * value};
}

Rgb MaterialValue::per_lobe(std::size_t h, std::size_t d, const Cosines &at) const {
    Rgb f{};
    for (std::size_t k = 0; k < lobes_.size(); ++k) {
        const double ndf = ndf_[h][k], alpha = lobes_[k].alpha;
        if (ndf == 0.0) continue; // far out on a sharp lobe
        const double value = smith_lobe(at, ndf, beckmann_sigma(at.i, alpha), beckmann_sigma(at.o, alpha));
        for (std::size_t c = 0; c < 3; ++c) f[c] += fresnel_[d][k][c] * value;
    }
    return f;
}

} // namespace smx
