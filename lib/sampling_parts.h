// A reference's samples cut into parts, each for one launch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling_plan.h"

namespace smx {

// As in cl/part.clh.
struct Part {
    std::int32_t scramble, scrambles;
    std::int32_t first, size;
    std::int32_t slots;
    std::int32_t all_scrambles, all_facets;

    bool is_last() const { return first + size == all_facets && scramble + scrambles == all_scrambles; }
};

// Scrambles that share a vector of `lanes` (SLICE_SUMS in cl/facet_integral.clh): several where each has few facets.
std::uint32_t scrambles_per_vector(const SamplingPlan &plan, std::uint32_t lanes);

// For `items` pixels or pairs at once: so many evaluations a part that launches count little, and so few that progress
// is told and a cancel heard several times a second; or `most` facets by each technique, a multiple of 256. Sums do not
// depend on where the parts end.
std::vector<Part> sampling_parts(const SamplingPlan &plan, std::size_t items, std::uint32_t lanes,
                                 std::uint32_t most = 0);

} // namespace smx
