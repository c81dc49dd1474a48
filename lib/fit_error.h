// How far a fitted material is from its table on a displaced sphere, where the table is not at hand.
#pragma once

#include "material.h"

namespace smx {

// relRMSE of the fit alone, widened without error, from its report: what the base has undisplaced. That is a bound
// rather than an estimate: displaced, 8 lobes of the per-lobe model had half of it in the median, and less than it in
// nine cases of ten (docs/choosing.md). Throws NoSolution for a material that was not fitted to a table.
double predicted_fit_error(const Material &material);

} // namespace smx
