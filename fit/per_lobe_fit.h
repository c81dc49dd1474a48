// The per-lobe model as the fit holds it, and its value at a sample.
#pragma once

#include <array>
#include <vector>

#include "curve_basis.h"
#include "direction_samples.h"

namespace smx {

// Coefficients (curve_basis.h) of one lobe's curves, by channel.
using CurveCoefficients = std::array<std::vector<double>, 3>;

struct PerLobeFit {
    std::vector<double> alphas;
    std::vector<CurveCoefficients> curves; // one set per alpha
};

// f at a sample whose theta_d has these shares.
Rgb value_at(const PerLobeFit &fit, const CurveShares &shares, const DirectionSample &sample);

// Relative error over all samples, by their weights: sqrt(sum (w (model - f))^2 / sum (w f)^2); 0 where f is all zeros.
double brdf_residual(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit);

} // namespace smx
