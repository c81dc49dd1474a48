// How far a fit is from its table on spheres, on the host: relRMSE as it is of images, without rendering one.
#pragma once

#include <vector>

#include "direction_samples.h"
#include "material.h"

namespace smx {

// Angles theta_d of the experiment's lights at 0, 90 and 115 degrees from the view; whole degrees, as the table's rows.
std::vector<double> light_angles();

// The table under these lights on displaced surfaces of alpha 0.1, 0.25 and 0.5.
std::vector<DirectionLevel> displaced_check(const Brdf &brdf);

// Mean over the levels of the relative root mean square error of the material, widened by each level's displacement.
double mean_relrmse(const std::vector<DirectionLevel> &levels, const Material &material);

} // namespace smx
