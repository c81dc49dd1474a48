// The statistical reference: the measured table integrated over the facets of X,
//   L(wi, wo) = (1 / p_o) integral f(wi_m, wo_m) <wi,wm>+ <wo,wm>+ G2_X D_X(wm) dwm
//             = G2_X / p_o  mean over slopes of f <wi,wm>+ <wo,wm>+ / wm.z
// The camera is orthographic and the light directional, so theta_d is one for the image and the table is cut there once.
// A work-item owns one pixel and takes W facets at a time.
//
// Sums: lanes and batches are added in floats over blocks of at most BLOCK samples, blocks in Neumaier's compensated
// sum, which is kept between launches. The error stays near BLOCK / 2 float roundings, whatever the sample count.
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_slice.clh); default 0
//   G2_SEPARABLE     0: height-correlated masking, 1: separable (masking.clh); default 0
#include "beckmann.clh"
#include "displacement.clh"
#include "masking.clh"
#include "sphere.clh"
#include "table_slice.clh"

#define BLOCK 256

// What is constant over a pixel.
typedef struct {
    float ix, iy, iz; // wi
    float hx, hy, hz; // wh
    float kx, ky, kz; // wh x wi
    float cos_d;      // <wi, wh>
    int lit;          // on the sphere and not turned away from the light
} Pixel;

// Sum over W facets of f <wi,wm>+ <wo,wm>+ / wm.z. Everything is told by the chord wm - wh, which is short where a sharp
// table is high and carries no cancellation there: <wi,wm> = cos_d + <wi,chord>, wo = 2 cos_d wh - wi.
inline float4 facet_sum(const Pixel *p, __global const float4 *slice, realW mx, realW my, realW mz, realW inv_mz,
                        intW valid) {
    realW cx = mx - p->hx, cy = my - p->hy, cz = mz - p->hz;
    realW chord2 = cx * cx + cy * cy + cz * cz;
    realW i_chord = p->ix * cx + p->iy * cy + p->iz * cz;
    realW i_m = p->cos_d + i_chord;
    realW o_m = p->cos_d - p->cos_d * chord2 - i_chord;
    intW seen = valid && (i_m > (realW)0.0f) && (o_m > (realW)0.0f);
    realW weight = select((realW)0.0f, i_m * o_m * inv_mz, seen);

    // phi_d: azimuth of wi about wh, from the direction in which theta_h grows.
    realW y = p->kx * cx + p->ky * cy + p->kz * cz;
    realW x = -i_chord - 0.5f * p->cos_d * chord2;
    return slice_sum(slice, slice_position(chord2, angle_modulo_pi(y, x)), weight);
}

// Adds `value` to the compensated sum (Neumaier 1974).
inline void add_compensated(float4 *sum, float4 *rest, float4 value) {
    float4 total = *sum + value;
    int4 larger = fabs(*sum) >= fabs(value);
    *rest += select((value - total) + *sum, (*sum - total) + value, larger);
    *sum = total;
}

inline float lane_0(realW v) {
    float lanes[W];
    vstoreW(v, 0, lanes);
    return lanes[0];
}

inline Pixel pixel_at(const SphereView *view, int column, int row) {
    SpherePoint s = sphere_point(view, (intW)column, (intW)row);
    Pixel p;
    p.ix = lane_0(SPHERE_LOCAL_X(s, view->wi_x, view->wi_y));
    p.iy = lane_0(SPHERE_LOCAL_Y(s, view->wi_x, view->wi_y));
    p.iz = lane_0(SPHERE_LOCAL_Z(s, view->wi_x, view->wi_y));
    p.hx = lane_0(SPHERE_LOCAL_X(s, view->wh_x, view->wh_y));
    p.hy = lane_0(SPHERE_LOCAL_Y(s, view->wh_x, view->wh_y));
    p.hz = lane_0(SPHERE_LOCAL_Z(s, view->wh_x, view->wh_y));
    float3 k = cross((float3)(p.hx, p.hy, p.hz), (float3)(p.ix, p.iy, p.iz));
    p.kx = k.x;
    p.ky = k.y;
    p.kz = k.z;
    p.cos_d = view->wi_x * view->wh_x + view->wi_y * view->wh_y;
    p.lit = lane_0(select((realW)0.0f, p.iz, s.inside)) > 0.0f;
    return p;
}

// Adds `size` facets ([4][stride], stride a multiple of W) to the sums of a band of rows, one work-item per pixel.
__kernel void integrate_reference(__global float4 *sums, __global float4 *rests, SphereView view, int first_row,
                                  __global const float4 *slice, __global const float *facets, int stride, int size) {
    int item = (int)get_global_id(0);
    Pixel p = pixel_at(&view, item % view.width, first_row + item / view.width);
    if (!p.lit) return;

    float4 sum = sums[item], rest = rests[item];
    for (int block = 0; block < size; block += BLOCK) {
        float4 partial = (float4)(0.0f);
        for (int at = block; at < min(block + BLOCK, size); at += W)
            partial += facet_sum(&p, slice, vloadW(0, facets + at), vloadW(0, facets + stride + at),
                                 vloadW(0, facets + 2 * stride + at), vloadW(0, facets + 3 * stride + at),
                                 (at + laneW) < (intW)size);
        add_compensated(&sum, &rest, partial);
    }
    sums[item] = sum;
    rests[item] = rest;
}

// Writes a band of pixels: mean over the facets times G2_X / p_o. 0 where either direction is not above the surface and
// its mean plane. Work-item (c, r) takes pixels W c ... W c + W - 1 of row first_row + r.
__kernel void finish_reference(__global float4 *rgba, __global const float4 *sums, __global const float4 *rests,
                               SphereView view, int first_row, Displacement x, float inv_samples) {
    int first_column = W * (int)get_global_id(0);
    int band_row = (int)get_global_id(1);
    SpherePoint s = sphere_point(&view, first_column + laneW, (intW)(first_row + band_row));
    realW ix = SPHERE_LOCAL_X(s, view.wi_x, view.wi_y), iy = SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y);
    realW iz = SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y);
    realW p_i = mean_plane(&x, ix, iy, iz), p_o = mean_plane(&x, s.ty, s.by, s.ny);
    intW visible = s.inside && (iz > (realW)0.0f) && (p_i > (realW)0.0f) && (p_o > (realW)0.0f);

    // Lanes that are not visible work on harmless numbers and are dropped at the end.
    realW safe_i = select((realW)1.0f, p_i, visible), safe_o = select((realW)1.0f, p_o, visible);
    realW factor = g2_over_po(safe_i, safe_o, beckmann_sigma(safe_i, displacement_s2(&x, ix, iy)),
                              beckmann_sigma(safe_o, displacement_s2(&x, s.ty, s.by)));
    realW scale = select((realW)0.0f, factor * inv_samples, visible);

    float scales[W];
    int inside[W];
    vstoreW(scale, 0, scales);
    vstoreW(s.inside, 0, inside);
    for (int lane = 0; lane < W && first_column + lane < view.width; ++lane) {
        int at = band_row * view.width + first_column + lane;
        rgba[at] = inside[lane] ? (float4)((sums[at].xyz + rests[at].xyz) * scales[lane], 1.0f) : (float4)(0.0f);
    }
}
