// The shared model's fit: a slope density's mixture, by EM (em.h) and least squares (refine.h), under the density's own
// Fresnel curves.
#pragma once

#include "fit_material.h"
#include "material.h"

namespace smx {

// With this number of lobes, 1..max_lobes, whatever options.lobes says. Throws NoSolution for a density without mass.
Material fit_mixture(const SlopeDensity &density, unsigned lobes, const FitOptions &options);

} // namespace smx
