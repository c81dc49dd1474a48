#include "material_at.h"

#include <cmath>

#include "microfacet.h"

namespace smx {

Rgb material_at(const Material &m, double theta_d, const DirectionSample &s) {
    const Cosines at = {s.ci, s.co, 1.0 / std::sqrt(1.0 + s.tan2), std::cos(theta_d)};
    double ndf = 0.0, sigma_i = 0.0, sigma_o = 0.0;
    Rgb f{};
    for (std::size_t k = 0; k < m.lobes.size(); ++k) {
        const double alpha2 = m.lobes[k].alpha * m.lobes[k].alpha + s.displacement2, alpha = std::sqrt(alpha2);
        const double lobe_ndf = std::exp(-s.tan2 / alpha2) * s.inv_cos4 / (std::numbers::pi * alpha2);
        const double lobe_sigma_i = beckmann_sigma(s.ci, alpha), lobe_sigma_o = beckmann_sigma(s.co, alpha);
        if (m.model == Model::Shared) {
            ndf += m.lobes[k].weight * lobe_ndf;
            sigma_i += m.lobes[k].weight * lobe_sigma_i;
            sigma_o += m.lobes[k].weight * lobe_sigma_o;
            continue;
        }
        const double lobe = smith_lobe(at, lobe_ndf, lobe_sigma_i, lobe_sigma_o);
        if (lobe == 0.0) continue; // far out on a sharp lobe
        const Rgb fresnel = fresnel_at(m.theta_d, m.fresnel[k], theta_d);
        for (std::size_t c = 0; c < 3; ++c) f[c] += fresnel[c] * lobe;
    }
    if (m.model == Model::PerLobe) return f;
    const double value = smith_lobe(at, ndf, sigma_i, sigma_o);
    f = fresnel_at(m.theta_d, m.fresnel[0], theta_d);
    for (double &channel : f) channel *= value;
    return f;
}

} // namespace smx
