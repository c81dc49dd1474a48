// Least-squares refinement of a mixture against a slope density, by Ceres.
#pragma once

#include <string>
#include <vector>

#include "material.h"

namespace smx {

struct RefineResult {
    std::vector<Lobe> lobes; // canonical order
    unsigned iterations = 0;
    std::string message;
};

// Minimises the Kullback-Leibler divergence of the mixture from the density over log alphas and log weights, as a sum
// of squares: the deviance residuals r_j^2 / 2 = mass_j log(p22_j / mixture_j) + area_j mixture_j - mass_j. It is the
// likelihood that EM climbs, so it finishes, with second-order steps, where EM slows down, and moves nothing away from
// the maximum. The start is returned where the solver fails.
RefineResult refine(const std::vector<Lobe> &start, const SlopeDensity &density);

// sqrt(1/2 integral (sqrt(p22) - sqrt(mixture))^2): Hellinger distance, 0 for equal densities, 1 for disjoint ones.
double hellinger(const std::vector<Lobe> &lobes, const SlopeDensity &density);

} // namespace smx
