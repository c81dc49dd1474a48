// The statistical reference: the measured table integrated over the facets of X,
//   L(wi, wo) = (1 / p_o) integral f(wi_m, wo_m) <wi,wm>+ <wo,wm>+ G2_X D_X(wm) dwm
// The camera is orthographic and the light directional, so theta_d is one for the image, the table is cut there once,
// and all pixels share the drawn facets (draw_facets.cl). A work-item owns one pixel and takes W facets at a time.
//
// Sums: lanes and batches are added in floats over blocks of at most BLOCK samples, blocks in Neumaier's compensated
// sum, which is kept between launches. The error stays near BLOCK / 2 float roundings, whatever the sample count.
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   TECHNIQUE        0: facets of X alone; 1: facets of X, weighted by the balance heuristic; 2: facets of the base's
//                    mixture about wh, weighted likewise; default 0
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_slice.clh); default 0
//   G2_SEPARABLE     0: height-correlated masking, 1: separable (masking.clh); default 0
#include "beckmann.clh"
#include "displacement.clh"
#include "masking.clh"
#include "proposal.clh"
#include "sphere.clh"
#include "table_slice.clh"

#ifndef TECHNIQUE
#define TECHNIQUE 0
#endif

#define FROM_X 0
#define FROM_X_BALANCED 1
#define ABOUT_WH_BALANCED 2

#define BLOCK 256

// What is constant over a pixel.
typedef struct {
    float ix, iy, iz; // wi
    float hx, hy, hz; // wh
    float kx, ky, kz; // wh x wi
    float ax, ay, az; // with b: a frame about wh
    float bx, by, bz;
    float cos_d; // <wi, wh>
    int lit;     // on the sphere and not turned away from the light
} Pixel;

inline float lane_0(realW v) {
    float lanes[W];
    vstoreW(v, 0, lanes);
    return lanes[0];
}

inline Pixel pixel_at(const SphereView *view, int column, int row) {
    SpherePoint s = sphere_point(view, (intW)column, row);
    Pixel p;
    p.ix = lane_0(SPHERE_LOCAL_X(s, view->wi_x, view->wi_y));
    p.iy = lane_0(SPHERE_LOCAL_Y(s, view->wi_x, view->wi_y));
    p.iz = lane_0(SPHERE_LOCAL_Z(s, view->wi_x, view->wi_y));
    p.hx = lane_0(SPHERE_LOCAL_X(s, view->wh_x, view->wh_y));
    p.hy = lane_0(SPHERE_LOCAL_Y(s, view->wh_x, view->wh_y));
    p.hz = lane_0(SPHERE_LOCAL_Z(s, view->wh_x, view->wh_y));
    float3 h = (float3)(p.hx, p.hy, p.hz);
    float3 k = cross(h, (float3)(p.ix, p.iy, p.iz));
    p.kx = k.x;
    p.ky = k.y;
    p.kz = k.z;
    float3 a =
        normalize(fabs(h.z) < 0.9f ? cross((float3)(0.0f, 0.0f, 1.0f), h) : cross((float3)(1.0f, 0.0f, 0.0f), h));
    float3 b = cross(h, a);
    p.ax = a.x;
    p.ay = a.y;
    p.az = a.z;
    p.bx = b.x;
    p.by = b.y;
    p.bz = b.z;
    p.cos_d = view->wi_x * view->wh_x + view->wi_y * view->wh_y;
    p.lit = lane_0(select((realW)0.0f, p.iz, s.inside)) > 0.0f;
    return p;
}

// W facets, as the integrand sees them.
typedef struct {
    realW cx, cy, cz; // chord wm - wh
    realW inv_mz;     // 1 / wm.z
    realW p_x;        // density of X's facets over solid angle
    realW correction; // tabulated over true density of the proposal
    intW above;       // wm.z > 0
} Facets;

#if TECHNIQUE == ABOUT_WH_BALANCED
inline Facets load_facets(const Pixel *p, const Displacement *x, __global const float *facets, int stride, int at) {
    realW a = vloadW(0, facets + at), b = vloadW(0, facets + stride + at), z_1 = vloadW(0, facets + 2 * stride + at);
    Facets m;
    m.cx = a * p->ax + b * p->bx + z_1 * p->hx;
    m.cy = a * p->ay + b * p->by + z_1 * p->hy;
    m.cz = a * p->az + b * p->bz + z_1 * p->hz;
    m.correction = vloadW(0, facets + 3 * stride + at);

    // Density of X there, from the slopes.
    realW mz = p->hz + m.cz;
    m.above = mz > (realW)0.0f;
    realW safe_mz = select((realW)1.0f, mz, m.above);
    realW slope_x = facet_slope(p->hx + m.cx, safe_mz), slope_y = facet_slope(p->hy + m.cy, safe_mz);
    realW d11, d22;
    principal_slopes2(x, slope_x, slope_y, &d11, &d22);
    realW inv_cos2 = (realW)1.0f + slope_x * slope_x + slope_y * slope_y;
    m.inv_mz = sqrt(inv_cos2);
    float peak = 1.0f / (M_PI_F * sqrt(x->var_1) * sqrt(x->var_2));
    m.p_x = peak * exp_negative(-d11 / x->var_1 - d22 / x->var_2) * inv_cos2 * m.inv_mz;
    return m;
}
#else
inline Facets load_facets(const Pixel *p, const Displacement *x, __global const float *facets, int stride, int at) {
    Facets m;
    m.cx = vloadW(0, facets + at) - p->hx;
    m.cy = vloadW(0, facets + stride + at) - p->hy;
    m.cz = vloadW(0, facets + 2 * stride + at) - p->hz;
    m.inv_mz = vloadW(0, facets + 3 * stride + at);
    m.above = (intW)1 == (intW)1;
#if TECHNIQUE == FROM_X_BALANCED
    m.p_x = vloadW(0, facets + 4 * stride + at);
    m.correction = (realW)1.0f;
#endif
    return m;
}
#endif

// Sum over W facets of f <wi,wm>+ <wo,wm>+ D_X / density. Everything is told by the chord wm - wh, which is short where
// a sharp table is high and carries no cancellation there: <wi,wm> = cos_d + <wi,chord>, wo = 2 cos_d wh - wi.
inline float4 facet_sum(const Pixel *p, const Facets *m, __global const float4 *slice, __constant const float *density,
                        intW valid) {
    realW chord2 = m->cx * m->cx + m->cy * m->cy + m->cz * m->cz;
    realW i_chord = p->ix * m->cx + p->iy * m->cy + p->iz * m->cz;
    realW i_m = p->cos_d + i_chord;
    realW o_m = p->cos_d - p->cos_d * chord2 - i_chord;
    intW seen = valid && m->above && (i_m > (realW)0.0f) && (o_m > (realW)0.0f);

    // phi_d: azimuth of wi about wh, from the direction in which theta_h grows.
    realW y = p->kx * m->cx + p->ky * m->cy + p->kz * m->cz;
    realW x = -i_chord - 0.5f * p->cos_d * chord2;
    realW row = slice_row(chord2);
    SlicePosition at = slice_position(row, angle_modulo_pi(y, x));

    // D_X over the density of the facets: 1 / wm.z for facets of X, times the balance heuristic where there are two.
    realW weight = i_m * o_m * m->inv_mz;
#if TECHNIQUE != FROM_X
    realW q = proposal_density(density, row);
    weight *= m->correction * 2.0f * m->p_x / (m->p_x + q); // both techniques draw half of the samples
    seen = seen && (m->p_x > (realW)0.0f);
#endif
    return slice_sum(slice, at, select((realW)0.0f, weight, seen));
}

// Adds `value` to the compensated sum (Neumaier 1974).
inline void add_compensated(float4 *sum, float4 *rest, float4 value) {
    float4 total = *sum + value;
    int4 larger = fabs(*sum) >= fabs(value);
    *rest += select((value - total) + *sum, (*sum - total) + value, larger);
    *sum = total;
}

// Adds `size` facets (stride a multiple of W) to the sums of a band of rows, one work-item per pixel. `density` is the
// proposal's table (proposal.clh), unused by TECHNIQUE 0.
__kernel void integrate_reference(__global float4 *sums, __global float4 *rests, SphereView view, int first_row,
                                  Displacement x, __global const float4 *slice, __constant float *density,
                                  __global const float *facets, int stride, int size) {
    int item = (int)get_global_id(0);
    Pixel p = pixel_at(&view, item % view.width, first_row + item / view.width);
    if (!p.lit) return;

    float4 sum = sums[item], rest = rests[item];
    for (int block = 0; block < size; block += BLOCK) {
        float4 partial = (float4)(0.0f);
        for (int at = block; at < min(block + BLOCK, size); at += W) {
            Facets m = load_facets(&p, &x, facets, stride, at);
            partial += facet_sum(&p, &m, slice, density, (at + laneW) < (intW)size);
        }
        add_compensated(&sum, &rest, partial);
    }
    sums[item] = sum;
    rests[item] = rest;
}

// Takes a finished scramble, its `samples` summed, into the running mean and squared deviations over scrambles (Welford
// 1962), as number `scramble` from 1, and clears the sums.
__kernel void fold_scramble(__global float4 *sums, __global float4 *rests, __global float4 *means,
                            __global float4 *deviations, float inv_samples, int scramble) {
    int item = (int)get_global_id(0);
    float4 value = (sums[item] + rests[item]) * inv_samples;
    float4 before = scramble == 1 ? (float4)(0.0f) : means[item];
    float4 squares = scramble == 1 ? (float4)(0.0f) : deviations[item];
    float4 mean = before + (value - before) / (float)scramble;
    means[item] = mean;
    deviations[item] = squares + (value - before) * (value - mean);
    sums[item] = (float4)(0.0f);
    rests[item] = (float4)(0.0f);
}

// Writes a band of pixels, mean times G2_X / p_o, and its standard error from `scrambles` independent estimates (0
// where there is one). 0 where either direction is not above the surface and its mean plane. Work-item (c, r) takes
// pixels W c ... W c + W - 1 of row first_row + r.
__kernel void finish_reference(__global float4 *rgba, __global float4 *errors, __global const float4 *means,
                               __global const float4 *deviations, SphereView view, int first_row, Displacement x,
                               int scrambles) {
    int first_column = W * (int)get_global_id(0);
    int band_row = (int)get_global_id(1);
    SpherePoint s = sphere_point(&view, first_column + laneW, first_row + band_row);
    realW ix = SPHERE_LOCAL_X(s, view.wi_x, view.wi_y), iy = SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y);
    realW iz = SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y);
    realW p_i = mean_plane(&x, ix, iy, iz), p_o = mean_plane(&x, s.ty, s.by, s.ny);
    intW visible = s.inside && (iz > (realW)0.0f) && (p_i > (realW)0.0f) && (p_o > (realW)0.0f);

    // Lanes that are not visible work on harmless numbers and are dropped at the end.
    realW safe_i = select((realW)1.0f, p_i, visible), safe_o = select((realW)1.0f, p_o, visible);
    realW factor = g2_over_po(safe_i, safe_o, beckmann_sigma(safe_i, displacement_s2(&x, ix, iy)),
                              beckmann_sigma(safe_o, displacement_s2(&x, s.ty, s.by)));
    float scales[W];
    int inside[W];
    vstoreW(select((realW)0.0f, factor, visible), 0, scales);
    vstoreW(s.inside, 0, inside);
    float inv_pairs = scrambles > 1 ? 1.0f / ((float)scrambles * (float)(scrambles - 1)) : 0.0f;
    for (int lane = 0; lane < W && first_column + lane < view.width; ++lane) {
        int at = band_row * view.width + first_column + lane;
        rgba[at] = inside[lane] ? (float4)(means[at].xyz * scales[lane], 1.0f) : (float4)(0.0f);
        errors[at] =
            inside[lane] ? (float4)(sqrt(deviations[at].xyz * inv_pairs) * scales[lane], 1.0f) : (float4)(0.0f);
    }
}
