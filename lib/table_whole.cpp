#include "table_whole.h"

#include "table_slice.h"

namespace smx {

std::vector<float> table_whole(const Brdf &brdf) {
    std::vector<float> nodes;
    nodes.reserve(4 * Brdf::theta_h_count * Brdf::theta_d_count * (slice_columns + 1));
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t d = 0; d < Brdf::theta_d_count; ++d)
            for (std::size_t column = 0; column <= slice_columns; ++column) {
                for (std::size_t c = 0; c < 3; ++c)
                    nodes.push_back(static_cast<float>(folded(brdf, c, h, d, column % slice_columns)));
                nodes.push_back(0.0f);
            }
    return nodes;
}

} // namespace smx
