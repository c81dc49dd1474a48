// Faults of a measurement that are no holes: cells far above everything beside them.
#pragma once

#include <optional>

#include "brdf.h"

namespace smx {

// The table with its outliers made invalid, and filled as holes are; nothing where it has none. An outlier's sum of
// channels is more than 30 times the median of its row in phi_d, and of the rows before and after it in theta_h: along
// phi_d measured tables vary by a few, not by tens.
std::optional<Brdf> without_outliers(const Brdf &brdf);

} // namespace smx
