// From the tile of the geometric reference to a displaced surface: what the device knows of both.
#pragma once

#include <cstdint>

#include "height_field.h"
#include "scene.h"

namespace smx {

// As TileFrame in cl/height_field.clh. Heights of the surface X over the point (x, y) are
//     f(A (x, y)) + mean_x x + mean_y y
// with the tile's field f: a ray of direction w goes through the tile in direction (A (w.x, w.y), p(w)), p the
// projected area of X's mean plane, and a facet of gradient g has the slope A' g + mean. A is chosen so that the slopes
// of facets have X's covariance, exactly so in the ensemble; where X has no roughness along an axis, A has no rank.
struct TileFrame {
    float a_xx, a_xy, a_yx, a_yy; // A: row x, row y
    float mean_x, mean_y;
    float top;
    std::int32_t log2_side;
};

TileFrame tile_frame(const HeightField &field, const Displacement &displacement);

} // namespace smx
