// Rays against the tile, one by one: what the geometric reference does to a pixel's samples, for those who want to see
// it. Work-item k casts the ray that comes from the viewer at origins[k], over the whole tile as 32 bits, and from
// where it meets the surface one to the light.
#include "height_field.clh"

typedef struct {
    float slope_x, slope_y; // of the triangle, in the surface's frame
    float x, y, z;          // the point, within the cell
    int cell_x, cell_y;     // before they are taken modulo the tile
    int upper, lit;         // of a ray that meets nothing, upper is -1
} CastRay;

__kernel void cast_rays(__global CastRay *out, int count, TileFrame frame, __global const float *heights,
                        __global const float *maxima, __global const uint2 *origins, __global const float4 *to_viewer,
                        __global const float4 *to_light) {
    int k = (int)get_global_id(0);
    if (k >= count) return;
    Surface s = {frame, heights, maxima};
    CastRay ray = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, 0, -1, 0};
    float4 wo = to_viewer[k], wi = to_light[k];
    float3 d = -tile_direction(&s, wo.x, wo.y, wo.z);
    TilePoint start = tile_point(&s, origins[k].x, origins[k].y, frame.top);
    TileHit hit;
    if (cast_ray(&s, start, d, -1, &hit)) {
        TilePoint p = hit_point(&s, start, d, &hit);
        float2 slope = facet_slope_of(&s, hit.cell_x, hit.cell_y, hit.upper);
        ray.slope_x = slope.x, ray.slope_y = slope.y;
        ray.x = p.x, ray.y = p.y, ray.z = p.z;
        ray.cell_x = hit.cell_x, ray.cell_y = hit.cell_y, ray.upper = hit.upper;
        TileHit blocker;
        ray.lit = wi.z - wi.x * slope.x - wi.y * slope.y > 0.0f &&
                  !cast_ray(&s, p, tile_direction(&s, wi.x, wi.y, wi.z), hit.upper, &blocker);
    }
    out[k] = ray;
}
