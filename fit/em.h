// EM for a mixture of zero-mean isotropic Beckmann lobes on a weighted radial slope density. In s = slope^2 each lobe
// is an exponential density of mean alpha^2, so both steps are exact (Dempster, Laird, Rubin 1977).
#pragma once

#include <vector>

#include "material.h"

namespace smx {

struct EmResult {
    std::vector<Lobe> lobes; // canonical order; fewer than asked for where lobes died
    unsigned iterations = 0;
    double log_likelihood = 0.0;
    double largest_fall = 0.0; // of the likelihood in a step: EM never falls but for roundings and lobes that die
};

// From the best of several starts (em_starts.h): each climbs 50 steps, then the one of highest likelihood goes on,
// until the mean log likelihood gains less than `tolerance` in a step, or after max_iterations. Throws NoSolution for a
// density without mass.
EmResult fit_em(const SlopeDensity &density, unsigned lobes, double tolerance, unsigned max_iterations);

// Joins neighbours where one lobe describes the density as well: lobes that a fit had to spare end up side by side.
// `lobes` are in canonical order.
void merge_redundant(std::vector<Lobe> &lobes, const SlopeDensity &density);

// The same from one start.
EmResult climb(std::vector<Lobe> start, const SlopeDensity &density, double tolerance, unsigned max_iterations);

// log sum exp(logs), without overflow.
double log_sum_exp(const std::vector<double> &logs);

// Logarithm of the mixture's slope density at squared slope s, by log-sum-exp.
double log_p22(const std::vector<Lobe> &lobes, double s);

// Mean of log p22 of the mixture under the density, per unit mass.
double mean_log_likelihood(const std::vector<Lobe> &lobes, const SlopeDensity &density);

} // namespace smx
