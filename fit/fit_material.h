// The fit, from measured table to material: inversion (lib/slope_density.h), EM (em.h), Ceres
// (refine.h), and for the per-lobe model its curves (fit_per_lobe.h).
#pragma once

#include "brdf.h"
#include "material.h"

namespace smx {

struct FitOptions {
    Model model = Model::PerLobe;
    unsigned lobes = 8;
    double tolerance = 1e-6;
    unsigned max_iterations = 20000;
    bool refine = true;
};

void validate(const FitOptions &options);

// Throws NoSolution when the density cannot be fitted.
Material fit_material(const Brdf &brdf, const SlopeDensity &density, const FitOptions &options);

// A density without a table: the shared model only. Throws InvalidArgument for the other one.
Material fit_material(const SlopeDensity &density, const FitOptions &options);

} // namespace smx
