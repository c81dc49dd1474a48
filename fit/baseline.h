// Baselines: the few-parameter models that a mixture must beat, fitted to the same samples with the same weights.
#pragma once

#include <string>

#include "brdf.h"
#include "brdf_errors.h"

namespace smx {

enum class Baseline { Beckmann = 0, Ggx = 1, GgxLambert = 2 };

// f_c = (f0_c + (1 - f0_c)(1 - cos theta_d)^5) D G2 / (4 cos_i cos_o) + kd_c / pi, with height-correlated Smith G2.
struct BaselineFit {
    double alpha = 0.0;
    Rgb f0{}, kd{};        // >= 0; kd is 0 but for GgxLambert
    double residual = 0.0; // relative, over the fit's samples by their weights, as refine_per_lobe.h's
    unsigned iterations = 0;
    std::string message; // the solver's verdict
    double seconds = 0.0;
    BrdfErrors errors;
};

// Least squares under a Cauchy loss per sample (direction_samples.h), by Ceres, from the best two of several alphas;
// the colours that go with an alpha are linear. Throws InvalidArgument for an unknown kind, NoSolution for a table with
// no measured cell above the horizon, or of zeros.
BaselineFit fit_baseline(const Brdf &brdf, Baseline kind);

} // namespace smx
