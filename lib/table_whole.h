// A whole measured table, as cl/table_whole.clh reads it.
#pragma once

#include <vector>

#include "brdf.h"

namespace smx {

// RGB and a zero per node, [theta_h][theta_d][phi_d columns over 0..pi, and the first one again]. A table over the full
// azimuth is folded as table_slice.h folds it.
std::vector<float> table_whole(const Brdf &brdf);

} // namespace smx
