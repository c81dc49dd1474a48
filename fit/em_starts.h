// Where EM begins.
#pragma once

#include <cstdint>
#include <vector>

#include "material.h"

namespace smx {

// Equal shares of the mass in order of slope, each lobe with its share's mean squared slope.
std::vector<Lobe> quantile_start(const SlopeDensity &density, unsigned count);

// Clusters of log slope, weighted by mass, begun far from each other at random (Arthur, Vassilvitskii, "k-means++",
// 2007): it sees narrow lobes of little mass that quantiles pass over.
std::vector<Lobe> cluster_start(const SlopeDensity &density, unsigned count, std::uint64_t seed);

} // namespace smx
