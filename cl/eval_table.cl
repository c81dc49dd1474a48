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
    realW ix = load_floatsW(0, wi + at), iy = load_floatsW(0, wi + stride + at),
          iz = load_floatsW(0, wi + 2 * stride + at);
    realW ox = load_floatsW(0, wo + at), oy = load_floatsW(0, wo + stride + at),
          oz = load_floatsW(0, wo + 2 * stride + at);
    intW above = (iz > (realW)0.0f) && (oz > (realW)0.0f);

    // What is below takes the normal's place, so that every lane has angles.
    realW up = (realW)1.0f, level = (realW)0.0f;
    TableAngles angles =
        table_angles(selectW(level, ix, above), selectW(level, iy, above), selectW(up, iz, above),
                     selectW(level, ox, above), selectW(level, oy, above), selectW(up, oz, above), level, level, up);
    realW r, g, b;
    table_values(table, table_position(angles), selectW(level, up, above), &r, &g, &b);
    store_floatsW(r, 0, f + at);
    store_floatsW(g, 0, f + stride + at);
    store_floatsW(b, 0, f + 2 * stride + at);
}
