// How well the table determines the per-lobe model's parameters.
#pragma once

#include <vector>

#include "material.h"
#include "per_lobe_fit.h"

namespace smx {

// Standard deviations, from the covariance of the problem at the fit, scaled by the residual variance (residual sum
// of squares over samples less free parameters). Parameters at a bound are held: they are not free and have none, nor
// has an alpha whose lobe has no energy. The curves' are times `scale`, as the fit's curves are stored.
Deviations deviations(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit, double scale);

} // namespace smx
