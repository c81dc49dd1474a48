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

// Least squares (per_lobe_problem.h) from result.fit. Where the solver fails, result.fit stays.
void refine_per_lobe(const std::vector<DirectionLevel> &levels, unsigned max_iterations, PerLobeRefinement &result);

// A Cauchy loss per sample, by reweighting (Holland, Welsch 1977): samples whose error is beyond a tenth of their
// level's value are taken for faults of the table and lose weight. Returns whether there were any.
bool reweigh(std::vector<DirectionLevel> &levels, const PerLobeFit &fit);

// Where the fit reflects more than `bound` (by theta_o of `albedo`, in the samples' units), fits its curves again with
// the bound in the problem; a last rest is scaled away.
void bound_energy(const std::vector<DirectionLevel> &levels, const DirectionalAlbedo &albedo,
                  const std::vector<Rgb> &bound, unsigned max_iterations, PerLobeRefinement &result);

} // namespace smx
