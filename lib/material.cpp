#include "material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.h"

namespace smx {

void validate(const Material &m) {
    require(!m.lobes.empty() && m.lobes.size() <= max_lobes, "a material has 1..", max_lobes, " lobes, not ",
            m.lobes.size());
    for (std::size_t k = 0; k < m.lobes.size(); ++k) {
        const auto [weight, alpha] = m.lobes[k];
        require(weight > 0.0 && std::isfinite(weight), "lobes[", k, "].weight is ", weight, "; it must be above 0");
        require(alpha >= min_alpha && alpha <= max_alpha, "lobes[", k, "].alpha is ", alpha, "; it must be ", min_alpha,
                "..", max_alpha);
    }
    const std::size_t knots = m.fresnel[0].size();
    require(knots >= 2 && knots <= 4096, "a Fresnel curve has 2..4096 knots, not ", knots);
    for (std::size_t c = 0; c < 3; ++c) {
        require(m.fresnel[c].size() == knots, "fresnel[", c, "] has ", m.fresnel[c].size(), " knots, fresnel[0] ",
                knots);
        for (std::size_t k = 0; k < knots; ++k)
            require(m.fresnel[c][k] >= 0.0 && std::isfinite(m.fresnel[c][k]), "fresnel[", c, "][", k, "] is ",
                    m.fresnel[c][k], "; it must be finite and not negative");
    }
}

void canonicalise(std::vector<Lobe> &lobes) {
    double total = 0.0;
    for (const Lobe &lobe : lobes) total += lobe.weight;
    for (Lobe &lobe : lobes) lobe.weight /= total;
    std::sort(lobes.begin(), lobes.end(), [](const Lobe &a, const Lobe &b) { return a.alpha < b.alpha; });
}

Rgb fresnel_at(const FresnelCurves &curves, double theta_d) {
    const auto last = curves[0].size() - 1;
    const double knot = std::clamp(theta_d / (std::numbers::pi / 2), 0.0, 1.0) * static_cast<double>(last);
    const auto below = std::min(static_cast<std::size_t>(knot), last - 1);
    const double share = knot - static_cast<double>(below);
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c) f[c] = std::lerp(curves[c][below], curves[c][below + 1], share);
    return f;
}

}  // namespace smx
