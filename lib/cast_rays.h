// Launch of cl/cast_rays.cl: single rays against the tile of the geometric reference.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "context.h"
#include "tile_frame.h"

namespace smx {

// Unit vectors that point away from the surface, and the tile's point over which the viewer's ray begins, at the tile's
// top: 2^32 is the tile's side.
struct RayPair {
    std::array<std::uint32_t, 2> origin;
    std::array<float, 3> wo, wi;
};

// As in cl/cast_rays.cl.
struct CastRay {
    float slope_x, slope_y;
    float x, y, z;
    std::int32_t cell_x, cell_y;
    std::int32_t upper, lit;
};

std::vector<CastRay> cast_rays(Context &context, const HeightField &field, const Displacement &displacement,
                               const std::vector<RayPair> &rays);

} // namespace smx
