// Fills invalid cells of a table from their nearest valid neighbours, so that interpolation never mixes a -1 in.
#pragma once

#include <vector>

#include "brdf.h"

namespace smx {

// Along phi_d first, where a table varies least: linear between the nearest valid cells on both sides, periodic. A row
// with no valid cell takes the nearest filled row along theta_d, a theta_h with none the nearest along theta_h.
// `valid` is by cell; values is [3][cells]. At least one cell must be valid.
void fill_holes(const Brdf &grid, const std::vector<bool> &valid, std::vector<double> &values);

} // namespace smx
