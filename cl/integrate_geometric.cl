// The geometric reference: rays against a displaced surface, as it is (height_field.clh). A pixel is the mean over the
// viewer's rays, which come evenly over its projected area, of
//   f(wi_m, wo_m) <wi,wm>+ V(wi)
// at the facet that the ray meets; V says whether a ray to the light meets nothing. What is masked is not met, and that
// is all that masking is here: Smith's formula appears nowhere. Light that has met several facets is followed from the
// viewer, facet by facet, in directions drawn from the base material (bounce.clh).
//
// A work-item is a pixel. Its paths go W at a time: rays one by one, the table and the drawing as vectors.
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   MASKING          1: the facets that the viewer's rays meet; 0: facets evenly over the surface, seen or not; default
//   1 SHADOWING        1: light comes where no facet is in its way; 0: to every facet that faces it; default 1
//   UNIFORM_LIGHT    0: a directional light of unit irradiance, 1: radiance 1 from every direction above; default 0
//   PATHS            0: the first facet alone, for a directional light; 1: paths of up to 1 + `bounces` facets; default
//   0 LOOKUP_NEAREST   0: linear, 1: nearest (table_whole.clh); default 0
#include "bounce.clh"
#include "height_field.clh"
#include "rgb.clh"
#include "sphere.clh"
#include "table_whole.clh"

#ifndef MASKING
#define MASKING 1
#endif
#ifndef SHADOWING
#define SHADOWING 1
#endif
#ifndef UNIFORM_LIGHT
#define UNIFORM_LIGHT 0
#endif
#ifndef PATHS
#define PATHS 0
#endif

// Where W paths stand.
typedef struct {
    TilePoint at[W];
    integer upper[W];         // the facet: half of its cell
    real mx[W], my[W], mz[W]; // its normal
    integer alive[W];         // the path goes on
    real ox[W], oy[W], oz[W]; // the direction that it came from
} Paths;

inline void set_facet(Paths *p, int lane, const Surface *s, TilePoint at, int upper) {
    float2 slope = facet_slope_of(s, at.cell_x, at.cell_y, upper);
    float z = 1.0f / sqrt(1.0f + slope.x * slope.x + slope.y * slope.y);
    p->at[lane] = at;
    p->upper[lane] = upper;
    p->mx[lane] = -slope.x * z;
    p->my[lane] = -slope.y * z;
    p->mz[lane] = z;
}

// The facet that a ray from the viewer meets, or, without masking, the one under a point. Returns its weight.
inline float first_facet(Paths *p, int lane, const Surface *s, uint x, uint y, float3 wo, float3 to_viewer) {
    TilePoint start = tile_point(s, x, y, s->frame.top);
#if MASKING
    TileHit hit;
    if (!cast_ray(s, start, -to_viewer, -1, &hit)) return 0.0f;
    set_facet(p, lane, s, hit_point(s, start, -to_viewer, &hit), hit.upper);
    return 1.0f;
#else
    int upper = start.x + start.y >= 1.0f;
    start.z = half_height(cell_corners(s, start.cell_x, start.cell_y), upper, start.x, start.y);
    set_facet(p, lane, s, start, upper);
    float o_m = wo.x * p->mx[lane] + wo.y * p->my[lane] + wo.z * p->mz[lane];
    return fmax(o_m, 0.0f) / (p->mz[lane] * to_viewer.z);
#endif
}

// Whether a lane's ray towards `d`, of the tile, leaves; else the path stands where it is met.
inline int follow_ray(Paths *p, int lane, const Surface *s, float3 d) {
    TileHit hit;
    TilePoint from = p->at[lane];
    if (!cast_ray(s, from, d, (int)p->upper[lane], &hit)) return 1;
    set_facet(p, lane, s, hit_point(s, from, d, &hit), hit.upper);
    return 0;
}

inline int leaves(const Paths *p, int lane, const Surface *s, float3 d) {
#if SHADOWING
    TileHit hit;
    return !cast_ray(s, p->at[lane], d, (int)p->upper[lane], &hit);
#else
    return 1;
#endif
}

inline VectorW load_vector(const real *x, const real *y, const real *z) {
    VectorW v = {vloadW(0, x), vloadW(0, y), vloadW(0, z)};
    return v;
}

// f of the pairs that are above their facets, 0 of the others.
inline RgbW facet_brdf(__global const float4 *table, VectorW wi, VectorW wo, VectorW wm, intW seen) {
    VectorW i = select_vector(wm, wi, seen), o = select_vector(wm, wo, seen); // harmless where not seen
    TablePosition at = table_position(table_angles(i.x, i.y, i.z, o.x, o.y, o.z, wm.x, wm.y, wm.z));
    RgbW f;
    table_values(table, at, selectW((realW)0.0f, (realW)1.0f, seen), &f.r, &f.g, &f.b);
    return f;
}

inline RgbW times(RgbW a, RgbW b) {
    RgbW c = {a.r * b.r, a.g * b.g, a.b * b.b};
    return c;
}

inline RgbW plus(RgbW a, RgbW b) {
    RgbW c = {a.r + b.r, a.g + b.g, a.b + b.b};
    return c;
}

// Light that comes straight to the facets where the paths stand.
inline RgbW direct_light(const Paths *p, const Surface *s, __global const float4 *table, VectorW wi, float3 to_light) {
    VectorW wm = load_vector(p->mx, p->my, p->mz), wo = load_vector(p->ox, p->oy, p->oz);
    realW i_m = dotW(wi, wm);
    intW seen = (i_m > (realW)0.0f) && (dotW(wo, wm) > (realW)0.0f) && (vloadW(0, p->alive) != (intW)0);
    integer lit[W];
    vstoreW(seen, 0, lit);
    for (int lane = 0; lane < W; ++lane)
        if (lit[lane]) lit[lane] = leaves(p, lane, s, to_light);
    seen = vloadW(0, lit) != (intW)0;
    return scaled(facet_brdf(table, wi, wo, wm, seen), selectW((realW)0.0f, i_m, seen));
}

// Numbers of a path's next facet, from its own seed.
inline UniformsW next_uniforms(const uint *seeds, int bounce) {
    real a[W], b[W], c[W];
    for (int lane = 0; lane < W; ++lane) {
        uint hash = pcg(seeds[lane] + (uint)bounce);
        a[lane] = uniform_open(hash);
        b[lane] = uniform_open(hash = pcg(hash + 0x9e3779b9u));
        c[lane] = uniform_open(pcg(hash + 0x9e3779b9u));
    }
    UniformsW u = {vloadW(0, a), vloadW(0, b), vloadW(0, c)};
    return u;
}

// Sends the paths on to their next facets, `throughput` times what their last one reflects. Returns the light of those
// that leave, where it comes from everywhere.
inline RgbW go_on(Paths *p, RgbW *throughput, const Surface *s, __global const float4 *table,
                  __constant const float2 *lobes, int lobe_count, UniformsW u) {
    VectorW wm = load_vector(p->mx, p->my, p->mz), wo = load_vector(p->ox, p->oy, p->oz);
    intW seen = (dotW(wo, wm) > (realW)0.0f) && (vloadW(0, p->alive) != (intW)0);
    VectorW safe_wo = select_vector(wm, wo, seen);
    Bounce b = draw_bounce(u, safe_wo, wm, lobes, lobe_count);
    seen = seen && (b.density > (realW)0.0f);
    realW weight = selectW((realW)0.0f, dotW(b.wi, wm) / selectW((realW)1.0f, b.density, seen), seen);
    *throughput = times(*throughput, scaled(facet_brdf(table, b.wi, safe_wo, wm, seen), weight));

    real lit[W];
    vstoreW(seen, 0, p->alive);
    vstoreW(b.wi.x, 0, p->ox);
    vstoreW(b.wi.y, 0, p->oy);
    vstoreW(b.wi.z, 0, p->oz);
    for (int lane = 0; lane < W; ++lane) {
        lit[lane] = 0.0f;
        if (!p->alive[lane]) continue;
        float3 d = tile_direction(s, p->ox[lane], p->oy[lane], p->oz[lane]);
        int left = follow_ray(p, lane, s, d);
#if SHADOWING
        lit[lane] = left;
#else
        lit[lane] = left || d.z > 0.0f;
#endif
        p->alive[lane] = !left;
        // At its next facet, the path comes from where it was.
        p->ox[lane] = -p->ox[lane], p->oy[lane] = -p->oy[lane], p->oz[lane] = -p->oz[lane];
    }
    return scaled(*throughput, vloadW(0, lit));
}

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
