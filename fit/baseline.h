// Baselines: the few-parameter models that a mixture must beat, fitted by the log error of brdf_errors.h.
#pragma once

#include <string>

#include "brdf.h"
#include "brdf_errors.h"

namespace smx {

enum class Baseline { Beckmann = 0, Ggx = 1, GgxLambert = 2 };

// f_c = (f0_c + (f90_c - f0_c)(1 - cos theta_d)^5) D G2 / (4 cos_i cos_o) + kd_c / pi, with height-correlated Smith G2.
struct BaselineFit {
    double alpha = 0.0;
    Rgb f0{}, f90{}, kd{}; // >= 0; kd is 0 but for GgxLambert
    double residual = 0.0; // log error of the cells that were fitted, relative to that of a black model
    unsigned iterations = 0;
    std::string message; // the solver's verdict
    double seconds = 0.0;
    BrdfErrors errors;
};

// Least squares, by Ceres, from the best two of several alphas; the colours that go with an alpha are linear but for
// the logarithm. Throws InvalidArgument for an unknown kind, NoSolution for a table with no measured cell above the
// horizon, or of zeros.
BaselineFit fit_baseline(const Brdf &brdf, Baseline kind);

} // namespace smx
