// Inversion: the radial slope density of a measured BRDF from its retro-reflection, and a Fresnel curve per channel.
// Dupuy, Heitz, Iehl, Poulin, Ostromoukhov, "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials with
// Power Iterations" (EGSR 2015), sections 3 and 4.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "brdf.h"

namespace smx {

enum class MaskingKernel { Coincides = 0, Correlated = 1 };

struct InversionOptions {
    MaskingKernel masking_kernel = MaskingKernel::Coincides;
    double tolerance = 1e-10;
    unsigned max_iterations = 1000;
};

void validate(const InversionOptions &options);

// Curves over theta_d = k pi/2 / (knots - 1), one per channel.
using FresnelCurves = std::array<std::vector<double>, 3>;

struct SlopeDensity {
    // On nodes in ascending slope: the density, the area of the slope plane that a node stands for, and mass = p22
    // area, which sums to 1.
    std::vector<double> slope, p22, area, mass;
    FresnelCurves fresnel;
    unsigned iterations = 0;
    bool converged = false;
    double change = 0.0;              // relative L1 change of the last iteration
    std::string name, source, sha256; // of the table or the file that it is from

    double alpha() const; // sqrt of the mean squared slope: Beckmann's alpha for one lobe
};

// Throws NoSolution when the table reflects nothing back.
SlopeDensity invert(const Brdf &brdf, const InversionOptions &options);

} // namespace smx
