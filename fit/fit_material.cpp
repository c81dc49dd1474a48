#include "fit_material.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "em.h"
#include "error.h"
#include "fit_per_lobe.h"
#include "refine.h"

namespace smx {

void validate(const FitOptions &o) {
    require(o.model == Model::Shared || o.model == Model::PerLobe, "model is ", static_cast<int>(o.model),
            "; it must be 0 (shared) or 1 (per-lobe)");
    require(o.lobes >= 1 && o.lobes <= max_lobes, "lobes is ", o.lobes, "; it must be 1..", max_lobes);
    require(o.tolerance > 0.0 && std::isfinite(o.tolerance), "tolerance is ", o.tolerance, "; it must be above 0");
    require(o.max_iterations >= 1 && o.max_iterations <= 1000000, "max_iterations is ", o.max_iterations,
            "; it must be 1..1000000");
}

namespace {

// The shared model, up to its report's time.
Material fit_mixture(const SlopeDensity &density, const FitOptions &options) {
    Material m;
    m.name = density.name;
    m.source = density.source;
    m.sha256 = density.sha256;
    m.fresnel = {density.fresnel};
    m.theta_d = uniform_knots(density.fresnel[0].size());
    m.report.inversion_iterations = density.iterations;

    // Maximise the likelihood.
    const EmResult em = fit_em(density, options.lobes, options.tolerance, options.max_iterations);
    m.lobes = em.lobes;
    m.report.em_iterations = em.iterations;
    m.report.log_likelihood_em = em.log_likelihood;
    m.report.residual_em = hellinger(m.lobes, density);

    // Refine by least squares; a solver that ends below its start changes nothing.
    if (options.refine) {
        const RefineResult refined = refine(em.lobes, density);
        m.report.refine_iterations = refined.iterations;
        m.report.refine_message = refined.message;
        if (mean_log_likelihood(refined.lobes, density) >= em.log_likelihood)
            m.lobes = refined.lobes;
        else
            m.report.refine_message += " (below EM's likelihood: EM's lobes kept)";
    }
    merge_redundant(m.lobes, density);
    m.report.log_likelihood = mean_log_likelihood(m.lobes, density);
    m.report.residual = hellinger(m.lobes, density);
    return m;
}

Material finished(Material m, std::chrono::steady_clock::time_point start) {
    m.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    validate(m);
    return m;
}

} // namespace

Material fit_material(const Brdf &brdf, const SlopeDensity &density, const FitOptions &options) {
    validate(options);
    const auto start = std::chrono::steady_clock::now();
    Material m = fit_mixture(density, options);
    if (options.model == Model::PerLobe) fit_per_lobe(brdf, m, options.refine);
    return finished(std::move(m), start);
}

Material fit_material(const SlopeDensity &density, const FitOptions &options) {
    validate(options);
    require(options.model == Model::Shared, "model is 1 (per-lobe), but the density ", density.source,
            " has no BRDF to fit its curves to; it must be 0 (shared)");
    const auto start = std::chrono::steady_clock::now();
    return finished(fit_mixture(density, options), start);
}

} // namespace smx
