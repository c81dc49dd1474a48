// The per-lobe model's fit, from a mixture's alphas: curves by non-negative least squares, then alphas and curves by
// Ceres.
#pragma once

#include <vector>

#include "fit_data.h"
#include "material.h"

namespace smx {

// A fit, its lobes in the material's order and its values over data.scale, and the samples that it is the least-squares
// solution of, with the weights that it ended with.
struct FittedCurves {
    PerLobeFit fit;
    std::vector<DirectionLevel> levels;
};

// A per-lobe material from these alphas; fills the curves' part of the report.
//
// Residuals are the base's and, with a share, those of displaced surfaces under the closed form, which the fit can
// partly make up for. That share is raised in steps for as long as the base pays little for it: a twentieth of its own
// relRMSE, or, up to 0.045, 0.006.
FittedCurves fit_per_lobe(const FitData &data, const std::vector<double> &alphas, bool refine, Material &material);

// Alphas spread evenly in the logarithm between the mixture's ends: another start.
std::vector<double> spread_alphas(const std::vector<Lobe> &mixture);

} // namespace smx
