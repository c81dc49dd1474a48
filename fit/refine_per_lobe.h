// Refinement of the per-lobe model in BRDF space, by Ceres: log alphas and all curves together.
#pragma once

#include <string>
#include <vector>

#include "direction_samples.h"
#include "lobe_curves.h"

namespace smx {

struct PerLobeFit {
    std::vector<double> alphas;
    std::vector<CurveCoefficients> curves; // one set per alpha
};

struct PerLobeRefinement {
    PerLobeFit fit;
    unsigned iterations = 0;
    std::string message;
};

// Residuals: (model - f) by the samples' weights, and the second differences of the curves' coefficients. Coefficients
// are bounded below by 0, alphas to 1e-4..1e4. Where the solver fails, the start comes back.
PerLobeRefinement refine_per_lobe(const std::vector<DirectionLevel> &levels, const PerLobeFit &start);

// Relative error over all samples, by their weights: sqrt(sum (w (model - f))^2 / sum (w f)^2).
double brdf_residual(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit);

} // namespace smx
