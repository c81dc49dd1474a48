#include "sampling_parts.h"

#include <algorithm>

#include "device_buffer.h"

namespace smx {

namespace {

constexpr std::uint32_t summation_block = 256; // BLOCK in cl/estimate.clh
constexpr std::uint64_t part_evaluations = 1u << 26;
constexpr std::uint64_t most_facets = 1u << 18; // in a buffer

// Facets of a part, by each technique.
std::uint32_t facets_per_part(const SamplingPlan &plan, std::size_t items) {
    const std::uint64_t wanted = part_evaluations / items / plan.passes.size();
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, summation_block, most_facets));
}

std::int32_t to_int(std::size_t count) { return static_cast<std::int32_t>(count); }

} // namespace

std::uint32_t scrambles_per_vector(const SamplingPlan &plan, std::uint32_t lanes) {
    std::uint32_t together = 1;
    while (2 * together <= std::min(lanes, plan.scrambles) && 2 * together * plan.passes[0].samples <= lanes)
        together *= 2;
    return together;
}

std::vector<Part> sampling_parts(const SamplingPlan &plan, std::size_t items, std::uint32_t lanes, std::uint32_t most) {
    const std::uint32_t facets = plan.passes[0].samples;
    if (most == 0) most = facets_per_part(plan, items);
    const std::uint32_t together = scrambles_per_vector(plan, lanes);
    // Several whole scrambles, or some of a scramble's blocks.
    const std::uint32_t scrambles = std::clamp(most / facets / together * together, together, plan.scrambles);
    const std::uint32_t blocks = std::max(most / summation_block, 1u);
    const std::uint32_t size = facets <= most ? facets : blocks * summation_block;
    const std::size_t slots = round_up(size, lanes / together);
    std::vector<Part> parts;
    for (std::uint32_t scramble = 0; scramble < plan.scrambles; scramble += scrambles)
        for (std::uint32_t first = 0; first < facets; first += size)
            parts.push_back({to_int(scramble), to_int(std::min(scrambles, plan.scrambles - scramble)), to_int(first),
                             to_int(std::min(size, facets - first)), to_int(slots), to_int(plan.scrambles),
                             to_int(facets)});
    return parts;
}

} // namespace smx
