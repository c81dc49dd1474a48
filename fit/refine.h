// Least-squares refinement of a mixture against a slope density, by Ceres.
#pragma once

#include <string>
#include <vector>

#include "material.h"

namespace smx {

struct RefineResult {
    std::vector<Lobe> lobes;  // canonical order
    unsigned iterations = 0;
    std::string message;
};

// Minimises the Hellinger distance of density and mixture over log alphas and the weights' logarithms: residuals
// sqrt(area) (sqrt(p22) - sqrt(mixture)), which give the peak and the tail their shares of the mass and are bounded
// where a quotient or a logarithm is not.
RefineResult refine(const std::vector<Lobe> &start, const SlopeDensity &density);

// sqrt(1/2 integral (sqrt(p22) - sqrt(mixture))^2), 0 for equal densities, 1 for disjoint ones.
double hellinger(const std::vector<Lobe> &lobes, const SlopeDensity &density);

}  // namespace smx
