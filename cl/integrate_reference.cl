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

// G2_X / p_o of W pairs. 0 where a direction is not above the mean plane.
inline realW masking_factor(const Displacement *x, realW ix, realW iy, realW iz, realW ox, realW oy, realW oz,
                            intW visible) {
    realW p_i = mean_plane(x, ix, iy, iz), p_o = mean_plane(x, ox, oy, oz);
    visible = visible && (p_i > (realW)0.0f) && (p_o > (realW)0.0f);

    // Lanes that are not visible work on harmless numbers and are dropped at the end.
    realW safe_i = selectW((realW)1.0f, p_i, visible), safe_o = selectW((realW)1.0f, p_o, visible);
    realW factor = g2_over_po(safe_i, safe_o, beckmann_sigma_beyond_p(safe_i, displacement_s2(x, ix, iy)),
                              beckmann_sigma_beyond_p(safe_o, displacement_s2(x, ox, oy)));
    return selectW((realW)0.0f, factor, visible);
}

// W pairs before their frames are made.
typedef struct {
    realW ix, iy, iz, hx, hy, hz, cos_d; // as in Pair
    realW theta_d;                       // in rows of the whole table
    realW factor;
    intW lit, there;
} PairsW;

// Stores the lanes from `at` that lie before `end`.
inline void store_pairs(__global Pair *pairs, int at, int end, const PairsW *from) {
    real v[9][W];
    integer lit[W], there[W];
    vstoreW(from->ix, 0, v[0]);
    vstoreW(from->iy, 0, v[1]);
    vstoreW(from->iz, 0, v[2]);
    vstoreW(from->hx, 0, v[3]);
    vstoreW(from->hy, 0, v[4]);
    vstoreW(from->hz, 0, v[5]);
    vstoreW(from->cos_d, 0, v[6]);
    vstoreW(from->theta_d, 0, v[7]);
    vstoreW(from->factor, 0, v[8]);
    vstoreW(from->lit, 0, lit);
    vstoreW(from->there, 0, there);
    for (int k = 0; k < W && at + k < end; ++k) {
        Pair p = make_pair((real3)(v[0][k], v[1][k], v[2][k]), (real3)(v[3][k], v[4][k], v[5][k]), v[6][k]);
        cut_table(&p, v[7][k]);
        p.factor = v[8][k];
        p.lit = lit[k] != 0;
        p.there = there[k] != 0;
        pairs[at + k] = p;
    }
}

// Work-item (c, r) prepares pixels W c ... W c + W - 1 of row first_row + r. `theta_d` is the image's, in rows.
__kernel void prepare_sphere(__global Pair *pairs, int first_row, Displacement x, SphereView view, real theta_d) {
    int first_column = W * (int)get_global_id(0), row = (int)get_global_id(1);
    SpherePoint s = sphere_point(&view, first_column + laneW, first_row + row);
    PairsW p;
    p.ix = SPHERE_LOCAL_X(s, view.wi_x, view.wi_y);
    p.iy = SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y);
    p.iz = SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y);
    p.hx = SPHERE_LOCAL_X(s, view.wh_x, view.wh_y);
    p.hy = SPHERE_LOCAL_Y(s, view.wh_x, view.wh_y);
    p.hz = SPHERE_LOCAL_Z(s, view.wh_x, view.wh_y);
    p.cos_d = (realW)(view.wi_x * view.wh_x + view.wi_y * view.wh_y);
    p.theta_d = (realW)theta_d;
    p.there = s.inside;
    p.lit = s.inside && (p.iz > (realW)0.0f);
    p.factor = masking_factor(&x, p.ix, p.iy, p.iz, s.ox, s.oy, s.oz, p.lit);
    store_pairs(pairs, row * view.width + first_column, (row + 1) * view.width, &p);
}

// Work-item c prepares pairs W c ... W c + W - 1 of `items` from number `first`. wi and wo are [3][stride], W numbers
// longer than the pairs.
__kernel void prepare_pairs(__global Pair *pairs, int first, Displacement x, int items, __global const float *wi,
                            __global const float *wo, int stride) {
    int item = W * (int)get_global_id(0), at = first + item;
    if (item >= items) return;
    realW ox = load_floatsW(0, wo + at), oy = load_floatsW(0, wo + stride + at),
          oz = load_floatsW(0, wo + 2 * stride + at);
    PairsW p;
    p.ix = load_floatsW(0, wi + at);
    p.iy = load_floatsW(0, wi + stride + at);
    p.iz = load_floatsW(0, wi + 2 * stride + at);
    realW hx = p.ix + ox, hy = p.iy + oy, hz = p.iz + oz;
    p.there = p.lit = (p.iz > (realW)0.0f) && (oz > (realW)0.0f);
    realW twice_cos_d = selectW((realW)1.0f, sqrt(hx * hx + hy * hy + hz * hz), p.lit);
    p.hx = hx / twice_cos_d;
    p.hy = hy / twice_cos_d;
    p.hz = hz / twice_cos_d;
    p.cos_d = 0.5f * twice_cos_d;
    p.theta_d = difference_angle(p.ix, p.iy, p.iz, ox, oy, oz) * (float)TABLE_THETA_D;
    p.factor = masking_factor(&x, p.ix, p.iy, p.iz, ox, oy, oz, p.lit);
    store_pairs(pairs, item, items, &p);
}

// Adds `size` facets to the sums of `items` pairs.
__kernel void integrate_reference(__global float4 *sums, __global float4 *rests, __global const Pair *pairs, int items,
                                  Displacement x, __global const float4 *table, __constant float *density,
                                  __global const float *facets, int stride, int size) {
    int item = (int)get_global_id(0);
    if (item >= items || !pairs[item].lit) return;
    Pair p = pairs[item];
    add_facets(sums + item, rests + item, &p, &x, table, density, facets, stride, size);
}

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

// Writes means times G2_X / p_o, and their standard errors from `scrambles` independent estimates (0 where there is
// one). Alpha is 0, and nothing there, off the sphere.
__kernel void finish_reference(__global float4 *rgba, __global float4 *errors, __global const float4 *means,
                               __global const float4 *deviations, __global const Pair *pairs, int items,
                               int scrambles) {
    int item = (int)get_global_id(0);
    if (item >= items) return;
    float factor = (float)pairs[item].factor;
    float inv_pairs = scrambles > 1 ? 1.0f / ((float)scrambles * (float)(scrambles - 1)) : 0.0f;
    float3 mean = means[item].xyz * factor, error = sqrt(deviations[item].xyz * inv_pairs) * factor;
    rgba[item] = pairs[item].there ? (float4)(mean, 1.0f) : (float4)(0.0f);
    errors[item] = pairs[item].there ? (float4)(error, 1.0f) : (float4)(0.0f);
}
