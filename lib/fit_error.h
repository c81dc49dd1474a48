// How far a fitted material is from its table on a displaced sphere, where the table is not at hand.
#pragma once

#include "material.h"
#include "scene.h"

namespace smx {

// relRMSE of the fit alone, widened without error: predicted from the fit's report by a calibrated relation, which is
// good to a factor of two (docs/choosing.md). Throws NoSolution for a material that was not fitted to a table.
double predicted_fit_error(const Material &material, const Displacement &displacement);

} // namespace smx
