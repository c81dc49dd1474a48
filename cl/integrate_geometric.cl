// The geometric reference: rays against a displaced surface, as it is (height_field.clh). A pixel is the mean over the
// viewer's rays, which come evenly over its projected area, of
//   f(wi_m, wo_m) <wi,wm>+ V(wi)
// at the facet that the ray meets; V says whether a ray to the light meets nothing. What is masked is not met, and that
// is all that masking is here: Smith's formula appears nowhere. Light that has met several facets is followed from the
// viewer, facet by facet, in directions drawn from the base material (bounce.clh).
//
// A work-item is a pixel. Its paths go W at a time (paths.clh).
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   MASKING          0: facets evenly over the surface, 1: those that rays meet (paths.clh); default 1
//   SHADOWING        0: light comes to every facet that faces it, 1: where nothing is in its way; default 1
//   UNIFORM_LIGHT    0: a directional light of unit irradiance, 1: radiance 1 from all above; default 0
//   PATHS            0: the first facet alone, directional light only, 1: 1 + `bounces` facets; default 0
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_whole.clh); default 0
#include "paths.clh"
#include "sphere.clh"

#ifndef UNIFORM_LIGHT
#define UNIFORM_LIGHT 0
#endif
#ifndef PATHS
#define PATHS 0
#endif

// What is constant over a pixel.
typedef struct {
    float3 wi, wo;
    float3 to_light, to_viewer; // the same in the tile
    int there, lit;             // on the sphere; both directions above the surface and its mean plane
} PixelView;

inline float first_lane(realW v) {
    real lanes[W];
    vstoreW(v, 0, lanes);
    return lanes[0];
}

inline PixelView pixel_view(const SphereView *view, int column, int row, const Surface *s) {
    SpherePoint p = sphere_point(view, (intW)column, row);
    PixelView v;
    v.there = anyW(p.inside);
    v.wi = (float3)(first_lane(SPHERE_LOCAL_X(p, view->wi_x, view->wi_y)),
                    first_lane(SPHERE_LOCAL_Y(p, view->wi_x, view->wi_y)),
                    first_lane(SPHERE_LOCAL_Z(p, view->wi_x, view->wi_y)));
    v.wo = (float3)(first_lane(p.ox), first_lane(p.oy), first_lane(p.oz));
    v.to_light = tile_direction(s, v.wi.x, v.wi.y, v.wi.z);
    v.to_viewer = tile_direction(s, v.wo.x, v.wo.y, v.wo.z);
    v.lit = v.there && v.to_viewer.z > 0.0f;
#if !UNIFORM_LIGHT
    v.lit = v.lit && v.wi.z > 0.0f && v.to_light.z > 0.0f;
#endif
    return v;
}

inline float sum_lanes(realW v) {
    real lanes[W];
    vstoreW(v, 0, lanes);
    float sum = 0.0f;
    for (int lane = 0; lane < W; ++lane) sum += lanes[lane];
    return sum;
}

// Steps of the two-dimensional golden ratio, 1/g and 1/g^2 with g^3 = g + 1, times 2^32: multiples of them cover the
// periodic tile evenly however many there are.
#define GOLDEN_X 3242174889u
#define GOLDEN_Y 2447445413u

// Rays of one launch begin in one window of the tile, of at most 256 x 256 cells, which a core's cache holds. Windows
// follow each other by golden steps, and so do a pixel's points within a window, from a start of its own.
#define LOG2_WINDOW 8

inline uint2 ray_origin(const Surface *s, uint window, uint2 start, uint index) {
    uint shift = (uint)max(s->frame.log2_side - LOG2_WINDOW, 0);
    return (uint2)(window * GOLDEN_X + ((start.x + index * GOLDEN_X) >> shift),
                   window * GOLDEN_Y + ((start.y + index * GOLDEN_Y) >> shift));
}

// Sums of a pixel's paths first, first + 1, ..., `size` of them, [rows][width]; alpha 1 on the sphere. Work-item (c, r)
// is pixel c of row first_row + r.
__kernel void integrate_geometric(__global float4 *sums, int first_row, SphereView view, TileFrame frame,
                                  __global const float *heights, __global const float *maxima,
                                  __global const float4 *table, __constant float2 *lobes, int lobe_count, int bounces,
                                  uint seed, uint window, uint first, uint size) {
    int column = (int)get_global_id(0), tile_row = (int)get_global_id(1), row = first_row + tile_row;
    if (column >= view.width) return;
    Surface s = {frame, heights, maxima};
    PixelView v = pixel_view(&view, column, row, &s);
    RgbW sum = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
    VectorW wi = {(realW)v.wi.x, (realW)v.wi.y, (realW)v.wi.z};
    uint pixel_seed = pcg((uint)(row * view.width + column) ^ pcg(seed));
    uint2 start = (uint2)(pcg(pixel_seed), pcg(pixel_seed + 1u));

    for (uint batch = first; v.lit && batch < first + size; batch += W) {
        // The first facets.
        Paths p;
        real weight[W];
        uint seeds[W];
        for (int lane = 0; lane < W; ++lane) {
            uint index = batch + (uint)lane;
            seeds[lane] = pcg(index ^ pixel_seed);
            p.ox[lane] = v.wo.x, p.oy[lane] = v.wo.y, p.oz[lane] = v.wo.z;
            p.mx[lane] = 0.0f, p.my[lane] = 0.0f, p.mz[lane] = 1.0f;
            uint2 origin = ray_origin(&s, window, start, index);
            weight[lane] =
                index < first + size ? first_facet(&p, lane, &s, origin.x, origin.y, v.wo, v.to_viewer) : 0.0f;
            p.alive[lane] = weight[lane] > 0.0f;
        }
        realW w = vloadW(0, weight);
#if !PATHS
        sum = plus(sum, scaled(direct_light(&p, &s, table, wi, v.to_light), w));
#else
        RgbW throughput = {w, w, w};
        for (int bounce = 0; bounce <= bounces; ++bounce) {
            if (!UNIFORM_LIGHT) {
                sum = plus(sum, times(throughput, direct_light(&p, &s, table, wi, v.to_light)));
                if (bounce == bounces) break;
            }
            UniformsW u = next_uniforms(seeds, bounce);
            RgbW escaped = go_on(&p, &throughput, &s, table, lobes, lobe_count, u);
            if (UNIFORM_LIGHT) sum = plus(sum, escaped);
            if (!anyW(vloadW(0, p.alive) != (intW)0)) break;
        }
#endif
    }
    sums[tile_row * view.width + column] =
        (float4)(sum_lanes(sum.r), sum_lanes(sum.g), sum_lanes(sum.b), v.there ? 1.0f : 0.0f);
}
