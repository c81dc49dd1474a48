// Refinement of the per-lobe model in BRDF space: log alphas and all curves together, by Ceres.
#pragma once

#include <string>
#include <vector>

#include "directional_albedo.h"
#include "per_lobe_fit.h"

namespace smx {

struct PerLobeRefinement {
    PerLobeFit fit;
    unsigned iterations = 0;
    std::string message; // the solver's own report of its last run
};

// Least squares (per_lobe_problem.h) under a Cauchy loss per sample, by reweighting (Holland, Welsch 1977): samples whose
// error is beyond a tenth of their level's value are taken for faults of the table. The albedo is held to its bound:
// where the fit exceeds it, the bound joins the problem; a last rest is scaled away. Where the solver fails, the start
// comes back.
PerLobeRefinement refine_per_lobe(const std::vector<DirectionLevel> &levels, const DirectionalAlbedo &albedo,
                                  const PerLobeFit &start, unsigned max_iterations);

} // namespace smx
