// The negative control of the hard cases: Beckmann lobes as they stand in textbooks and in most renderers, in float.
// Angles by acos and their tangents, Lambda directly by erf, the exponent from cosines. Only for uncorrelated surfaces
// of mean slope 0.
#pragma once

#include <utility>
#include <vector>

#include "hard_truth.h"

namespace test {

// Quantities and their values.
std::vector<std::pair<std::size_t, double>> textbook(const HardCase &c, const HardPair &pair);

} // namespace test
