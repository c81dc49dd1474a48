// What the table looks like on a displaced surface, for the fit: the statistical reference at some directions.
#pragma once

#include <vector>

#include "direction_samples.h"

namespace smx {

// Levels as direction_levels makes them, but on an isotropic displaced surface X of this alpha, at least 0.1: f is
//   L / ci = 1 / (sigma_X(i) co + sigma_X(o) ci - ci co) integral f(i_m, o_m) <i,m>+ <o,m>+ D_X(m) dm,
// the reference's value over the macro surface's cosine, integrated on the table's own nodes about wh: they resolve the
// table's peaks, and X's Gaussian, wide against their spacing, needs no more. Weights: weigh_levels, of a total
// `share`.
std::vector<DirectionLevel> displaced_levels(const Brdf &brdf, const std::vector<double> &theta_d, double alpha,
                                             double share);

} // namespace smx
