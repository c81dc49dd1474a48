#include "direction_pairs.h"

#include <algorithm>
#include <limits>

#include "error.h"
#include "opencl.h"

namespace smx {

void require_pair_count(std::size_t count) {
    constexpr std::size_t most = std::size_t{std::numeric_limits<cl_int>::max()} / 3 - 16;
    require(count <= most, "count is ", count, "; it must be 0..", most);
}

std::vector<float> to_planes(const float *packed, std::size_t count, std::size_t stride) {
    std::vector<float> planes(3 * stride, -1.0f);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) planes[axis * stride + k] = packed[3 * k + axis];
    return planes;
}

std::vector<float> padded_planes(const float *planes, std::size_t count, std::size_t stride) {
    std::vector<float> padded(3 * stride, -1.0f);
    for (std::size_t axis = 0; axis < 3; ++axis)
        std::copy_n(planes + axis * count, count, padded.begin() + static_cast<std::ptrdiff_t>(axis * stride));
    return padded;
}

void from_planes(const std::vector<float> &planes, std::size_t count, float *packed) {
    const std::size_t stride = planes.size() / 3;
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) packed[3 * k + axis] = planes[axis * stride + k];
}

} // namespace smx
