// Pairs of directions between the caller's packed arrays, [count][3], and the planes that kernels read, [3][stride].
#pragma once

#include <cstddef>
#include <vector>

namespace smx {

// Throws InvalidArgument for more pairs than a kernel can index.
void require_pair_count(std::size_t count);

// What pads the planes up to `stride` are directions below the surface.
std::vector<float> to_planes(const float *packed, std::size_t count, std::size_t stride);

// From planes of `count`.
std::vector<float> padded_planes(const float *planes, std::size_t count, std::size_t stride);

void from_planes(const std::vector<float> &planes, std::size_t count, float *packed);

} // namespace smx
