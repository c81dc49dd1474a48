// The linear stage of the per-lobe model: given the lobes' alphas, the non-negative Fresnel curves that fit best.
#pragma once

#include <vector>

#include "per_lobe_fit.h"

namespace smx {

// One set of curves per alpha. Non-negative least squares on the samples' weighted residuals, regularised by the
// smoothness of each curve in proportion to its lobe's own weight in the data; solved by Ceres with bounds.
std::vector<CurveCoefficients> fit_curves(const std::vector<DirectionLevel> &levels, const std::vector<double> &alphas);

} // namespace smx
