// The statistical reference: the measured table integrated over the facets of X (facet_integral.clh),
//   L(wi, wo) = (1 / p_o) integral f(wi_m, wo_m) <wi,wm>+ <wo,wm>+ G2_X D_X(wm) dwm
// for the pixels of the sphere or for pairs of directions; all share the drawn facets (draw_facets.cl), and a work-item
// owns one. On the sphere the camera is orthographic and the light directional, so theta_d is one for the image, and
// the table may be cut there once.
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   GRADE            0: precise, 1: fast, 2: double (vec.clh); default 0
//   TECHNIQUE        how the facets are drawn and weighted, 0..2 (facet_integral.clh); default 0
//   TABLE_WHOLE      0: the table is a slice, 1: it is whole (table_slice.clh); default 0
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_slice.clh); default 0
//   G2_SEPARABLE     0: height-correlated masking, 1: separable (masking.clh); default 0
#include "facet_integral.clh"
#include "fresnel.clh"
#include "masking.clh"
#include "sphere.clh"

inline Pair pair_of_pixel(const SphereView *view, int column, int row) {
    SpherePoint s = sphere_point(view, (intW)column, row);
    real3 i =
        (real3)(lane_0(SPHERE_LOCAL_X(s, view->wi_x, view->wi_y)), lane_0(SPHERE_LOCAL_Y(s, view->wi_x, view->wi_y)),
                lane_0(SPHERE_LOCAL_Z(s, view->wi_x, view->wi_y)));
    real3 h =
        (real3)(lane_0(SPHERE_LOCAL_X(s, view->wh_x, view->wh_y)), lane_0(SPHERE_LOCAL_Y(s, view->wh_x, view->wh_y)),
                lane_0(SPHERE_LOCAL_Z(s, view->wh_x, view->wh_y)));
    Pair p = make_pair(i, h, view->wi_x * view->wh_x + view->wi_y * view->wh_y);
    p.lit = lane_0(selectW((realW)0.0f, (realW)i.z, s.inside)) > 0.0f;
    return p;
}

// Both directions must be above the surface.
inline Pair pair_of_directions(real3 i, real3 o) {
    real3 sum = i + o;
    real twice_cos_d = length(sum);
    Pair p = make_pair(i, sum / twice_cos_d, 0.5f * twice_cos_d);
    p.lit = 1;
    return p;
}

// Adds `size` facets to the sums of `items` pixels from the first of row first_row. `theta_d` is in rows of the table.
__kernel void integrate_sphere(__global float4 *sums, __global float4 *rests, int items, int first_row, Displacement x,
                               __global const float4 *table, __constant float *density, __global const float *facets,
                               int stride, int size, SphereView view, real theta_d) {
    int item = (int)get_global_id(0);
    if (item >= items) return;
    Pair p = pair_of_pixel(&view, item % view.width, first_row + item / view.width);
    if (!p.lit) return;
    cut_table(&p, table, theta_d);
    add_facets(sums + item, rests + item, &p, &x, density, facets, stride, size);
}

#if TABLE_WHOLE
// The same for `items` pairs from number `first`; wi and wo are [3][pair_stride].
__kernel void integrate_pairs(__global float4 *sums, __global float4 *rests, int items, int first, Displacement x,
                              __global const float4 *table, __constant float *density, __global const float *facets,
                              int stride, int size, __global const float *wi, __global const float *wo,
                              int pair_stride) {
    int item = (int)get_global_id(0), at = first + item;
    if (item >= items) return;
    real3 i = (real3)(wi[at], wi[pair_stride + at], wi[2 * pair_stride + at]);
    real3 o = (real3)(wo[at], wo[pair_stride + at], wo[2 * pair_stride + at]);
    if (!(i.z > 0.0f && o.z > 0.0f)) return;
    Pair p = pair_of_directions(i, o);
    realW angle = difference_angle((realW)i.x, (realW)i.y, (realW)i.z, (realW)o.x, (realW)o.y, (realW)o.z);
    cut_table(&p, table, lane_0(angle) * (float)TABLE_THETA_D);
    add_facets(sums + item, rests + item, &p, &x, density, facets, stride, size);
}
#endif

// Takes a finished scramble, its `samples` summed, into the running mean and squared deviations over scrambles (Welford
// 1962), as number `scramble` from 1, and clears the sums.
__kernel void fold_scramble(__global float4 *sums, __global float4 *rests, __global float4 *means,
                            __global float4 *deviations, float inv_samples, int items, int scramble) {
    int item = (int)get_global_id(0);
    if (item >= items) return;
    float4 value = (sums[item] + rests[item]) * inv_samples;
    float4 before = scramble == 1 ? (float4)(0.0f) : means[item];
    float4 squares = scramble == 1 ? (float4)(0.0f) : deviations[item];
    float4 mean = before + (value - before) / (float)scramble;
    means[item] = mean;
    deviations[item] = squares + (value - before) * (value - mean);
    sums[item] = (float4)(0.0f);
    rests[item] = (float4)(0.0f);
}

// What the mean of W pairs is to be multiplied with, G2_X / p_o. 0 where a direction is not above the mean plane.
inline realW masking_factor(const Displacement *x, realW ix, realW iy, realW iz, realW ox, realW oy, realW oz,
                            intW visible) {
    realW p_i = mean_plane(x, ix, iy, iz), p_o = mean_plane(x, ox, oy, oz);
    visible = visible && (p_i > (realW)0.0f) && (p_o > (realW)0.0f);

    // Lanes that are not visible work on harmless numbers and are dropped at the end.
    realW safe_i = selectW((realW)1.0f, p_i, visible), safe_o = selectW((realW)1.0f, p_o, visible);
    realW factor = g2_over_po(safe_i, safe_o, beckmann_sigma(safe_i, displacement_s2(x, ix, iy)),
                              beckmann_sigma(safe_o, displacement_s2(x, ox, oy)));
    return selectW((realW)0.0f, factor, visible);
}

// Writes W results from `at`, up to `end`, and their standard errors from `scrambles` independent estimates (0 where
// there is one). Where not `inside`, nothing is there, alpha 0.
inline void store_results(__global float4 *rgba, __global float4 *errors, __global const float4 *means,
                          __global const float4 *deviations, int at, int end, realW factor, intW inside,
                          int scrambles) {
    float scales[W];
    integer in[W];
    store_floatsW(factor, 0, scales);
    vstoreW(inside, 0, in);
    float inv_pairs = scrambles > 1 ? 1.0f / ((float)scrambles * (float)(scrambles - 1)) : 0.0f;
    for (int lane = 0; lane < W && at + lane < end; ++lane) {
        float4 mean = means[at + lane], deviation = deviations[at + lane];
        rgba[at + lane] = in[lane] ? (float4)(mean.xyz * scales[lane], 1.0f) : (float4)(0.0f);
        errors[at + lane] = in[lane] ? (float4)(sqrt(deviation.xyz * inv_pairs) * scales[lane], 1.0f) : (float4)(0.0f);
    }
}

// Work-item (c, r) finishes pixels W c ... W c + W - 1 of row first_row + r.
__kernel void finish_sphere(__global float4 *rgba, __global float4 *errors, __global const float4 *means,
                            __global const float4 *deviations, int first_row, Displacement x, int scrambles,
                            SphereView view) {
    int first_column = W * (int)get_global_id(0), row = (int)get_global_id(1);
    SpherePoint s = sphere_point(&view, first_column + laneW, first_row + row);
    realW ix = SPHERE_LOCAL_X(s, view.wi_x, view.wi_y), iy = SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y);
    realW iz = SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y);
    realW factor = masking_factor(&x, ix, iy, iz, s.ox, s.oy, s.oz, s.inside && (iz > (realW)0.0f));
    store_results(rgba, errors, means, deviations, row * view.width + first_column, (row + 1) * view.width, factor,
                  s.inside, scrambles);
}

// Work-item c finishes pairs W c ... W c + W - 1 of `items` from number `first`; pair_stride is a multiple of W.
__kernel void finish_pairs(__global float4 *rgba, __global float4 *errors, __global const float4 *means,
                           __global const float4 *deviations, int first, Displacement x, int scrambles, int items,
                           __global const float *wi, __global const float *wo, int pair_stride) {
    int item = W * (int)get_global_id(0), at = first + item;
    if (item >= items) return;
    realW ix = load_floatsW(0, wi + at), iy = load_floatsW(0, wi + pair_stride + at),
          iz = load_floatsW(0, wi + 2 * pair_stride + at);
    realW ox = load_floatsW(0, wo + at), oy = load_floatsW(0, wo + pair_stride + at),
          oz = load_floatsW(0, wo + 2 * pair_stride + at);
    intW above = (iz > (realW)0.0f) && (oz > (realW)0.0f);
    store_results(rgba, errors, means, deviations, item, items, masking_factor(&x, ix, iy, iz, ox, oy, oz, above),
                  above, scrambles);
}
