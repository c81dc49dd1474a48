#include "fit_mixture.h"

#include "em.h"
#include "refine.h"

namespace smx {

Material fit_mixture(const SlopeDensity &density, unsigned lobes, const FitOptions &options) {
    Material m;
    m.name = density.name;
    m.source = density.source;
    m.sha256 = density.sha256;
    m.fresnel = {density.fresnel};
    m.theta_d = uniform_knots(density.fresnel[0].size());
    m.report.inversion_iterations = density.iterations;

    // Maximise the likelihood.
    const EmResult em = fit_em(density, lobes, options.tolerance, options.max_iterations);
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

} // namespace smx
