// A material's f at a sample of the fit, on the host in double, widened as the closed form widens it.
#pragma once

#include "direction_samples.h"
#include "material.h"

namespace smx {

// f in 1/sr; lobes of squared alpha a^2 + the sample's displacement2.
Rgb material_at(const Material &material, double theta_d, const DirectionSample &sample);

} // namespace smx
