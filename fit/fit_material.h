// The fit, from measured table to material: inversion (lib/slope_density.h), mixture (fit_mixture.h), and for the
// per-lobe model its curves (fit_per_lobe.h).
#pragma once

#include "brdf.h"
#include "material.h"

namespace smx {

constexpr unsigned auto_lobes = 0;

struct FitOptions {
    Model model = Model::PerLobe;
    unsigned lobes = 8; // or auto_lobes
    double tolerance = 1e-6;
    unsigned max_iterations = 20000;
    bool refine = true;
};

void validate(const FitOptions &options);

// auto_lobes: the smallest number whose next lobe lowers the Kullback-Leibler divergence from the slope density by less
// than 1e-3 nat and the mean relRMSE on displaced spheres by less than 0.005.
//
// A refined per-lobe fit that is worse on displaced spheres than the shared one by more than 2 % is tried again from
// other alphas; report.choice says so. Throws NoSolution when the density cannot be fitted.
Material fit_material(const Brdf &brdf, const SlopeDensity &density, const FitOptions &options);

// A density without a table: the shared model only. Throws InvalidArgument for the other one.
Material fit_material(const SlopeDensity &density, const FitOptions &options);

} // namespace smx
