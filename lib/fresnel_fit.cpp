#include "fresnel_fit.h"

#include <cmath>

namespace smx {

namespace {

// Quotient of the two sums over the cells of one theta_d; negative where there is nothing to divide.
Rgb energy_ratio(const Brdf &brdf, const std::vector<double> &ndf, const ProjectedArea &sigma, std::size_t d) {
    Rgb measured{};
    double model = 0.0;
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) {
            const std::size_t cell = brdf.cell(h, d, p);
            const Cosines at = Brdf::cosines(h, d, p);
            if (!brdf.valid(cell) || at.i <= 0.0 || at.o <= 0.0) continue;

            const double weight = Brdf::theta_h_weight(h);
            const double g2 = at.i * at.o / (sigma(at.i) * at.o + sigma(at.o) * at.i - at.i * at.o);
            model += weight * ndf[h] * g2 / 4;
            for (std::size_t c = 0; c < 3; ++c) measured[c] += weight * brdf.value(c, cell) * at.i * at.o;
        }
    Rgb ratio = {-1.0, -1.0, -1.0};
    if (model > 0.0)
        for (std::size_t c = 0; c < 3; ++c) ratio[c] = measured[c] / model;
    return ratio;
}

} // namespace

ProjectedArea projected_area(const std::vector<double> &ndf) {
    std::vector<double> theta, weight;
    for (std::size_t j = 0; j < ndf.size(); ++j) {
        theta.push_back(Brdf::theta_h(j));
        weight.push_back(ndf[j] * std::sin(theta[j]) * static_cast<double>(j));
    }
    return {theta, weight};
}

FresnelCurves fit_fresnel(const Brdf &brdf, const std::vector<double> &ndf) {
    const ProjectedArea sigma = projected_area(ndf);
    FresnelCurves curves;
    Rgb last{};
    for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) {
        const Rgb ratio = energy_ratio(brdf, ndf, sigma, d);
        if (ratio[0] >= 0.0) last = ratio;
        for (std::size_t c = 0; c < 3; ++c) curves[c].push_back(last[c]);
    }
    for (std::vector<double> &curve : curves) curve.push_back(curve.back()); // theta_d = pi/2 has no cell
    return curves;
}

} // namespace smx
