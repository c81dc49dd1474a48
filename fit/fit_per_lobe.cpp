#include "fit_per_lobe.h"

#include "curve_basis.h"
#include "direction_samples.h"
#include "error.h"
#include "refine_per_lobe.h"

namespace smx {

namespace {

std::vector<double> alphas_of(const std::vector<Lobe> &lobes) {
    std::vector<double> alphas;
    for (const Lobe &lobe : lobes) alphas.push_back(lobe.alpha);
    return alphas;
}

// Writes the fit into the material, its curves at whole degrees.
void store(const PerLobeFit &fit, Material &m) {
    m.model = Model::PerLobe;
    m.theta_d = uniform_knots(91);
    m.fresnel.clear();
    for (const CurveCoefficients &coefficients : fit.curves) {
        m.fresnel.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) m.fresnel.back()[c] = curve_values(coefficients[c], m.theta_d);
    }
    const std::vector<double> shares = energy_shares(m.theta_d, m.fresnel);
    m.lobes.clear();
    for (std::size_t k = 0; k < shares.size(); ++k) m.lobes.push_back({shares[k], fit.alphas[k]});
    canonicalise(m);
}

} // namespace

void fit_per_lobe(const Brdf &brdf, Material &material, bool refine) {
    const std::vector<DirectionLevel> levels = direction_levels(brdf, curve_levels());
    if (levels.empty()) fail(Fault::NoSolution, brdf.name(), ": the table has no measured cell above the horizon");

    PerLobeFit fit{alphas_of(material.lobes), {}};
    fit.curves = fit_curves(levels, fit.alphas);
    FitReport &report = material.report;
    report.brdf_residual_start = report.brdf_residual = brdf_residual(levels, fit);
    if (refine) {
        const PerLobeRefinement refined = refine_per_lobe(levels, fit);
        report.curve_iterations = refined.iterations;
        report.curve_message = refined.message;
        const double residual = brdf_residual(levels, refined.fit);
        if (residual < report.brdf_residual) {
            fit = refined.fit;
            report.brdf_residual = residual;
        } else {
            report.curve_message += " (no better than its start, which is kept)";
        }
    }
    store(fit, material);
}

} // namespace smx
