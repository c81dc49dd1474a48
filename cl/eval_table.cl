// f of a measured table, not times a cosine, for pairs of directions (table_whole.clh).
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_whole.clh); default 0
#include "table_whole.clh"

// Pairs of directions as structure of arrays: wi, wo and f each [3][stride], stride a multiple of W. f is 0 where
// either direction is not above the surface.
__kernel void eval_table(__global float *f, int stride, __global const float *wi, __global const float *wo,
                         __global const float4 *table) {
    int at = W * (int)get_global_id(0);
    realW ix = vloadW(0, wi + at), iy = vloadW(0, wi + stride + at), iz = vloadW(0, wi + 2 * stride + at);
    realW ox = vloadW(0, wo + at), oy = vloadW(0, wo + stride + at), oz = vloadW(0, wo + 2 * stride + at);
    intW above = (iz > (realW)0.0f) && (oz > (realW)0.0f);

    // What is below takes the normal's place, so that every lane has angles.
    realW up = (realW)1.0f, level = (realW)0.0f;
    TableAngles angles =
        table_angles(select(level, ix, above), select(level, iy, above), select(up, iz, above),
                     select(level, ox, above), select(level, oy, above), select(up, oz, above), level, level, up);
    realW r, g, b;
    table_values(table, table_position(angles), select(level, up, above), &r, &g, &b);
    vstoreW(r, 0, f + at);
    vstoreW(g, 0, f + stride + at);
    vstoreW(b, 0, f + 2 * stride + at);
}
