// The per-lobe model's fit, from EM's mixture: curves by non-negative least squares, then alphas and curves by Ceres.
#pragma once

#include "brdf.h"
#include "material.h"

namespace smx {

// Takes the lobes of `material` (a shared fit) as start, and makes it a per-lobe one; fills its report.
void fit_per_lobe(const Brdf &brdf, Material &material, bool refine);

} // namespace smx
