// The statistical reference: the measured table integrated over the facets of X (facet_integral.clh),
//   L(wi, wo) = (1 / p_o) integral f(wi_m, wo_m) <wi,wm>+ <wo,wm>+ G2_X D_X(wm) dwm
// for the pixels of the sphere or for pairs of directions; all share the drawn facets (draw_facets.cl), and a work-item
// owns W. On the sphere the camera is orthographic and the light directional, so theta_d is one for the image, and the
// table may be cut there once.
//
// A launch adds a Part of the samples. Between launches `estimates` keeps what is summed so far; the last one writes
// means times G2_X / p_o, and their standard errors (0 of one scramble). Alpha is 0, and nothing there, off the sphere.
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   GRADE            0: precise, 1: fast, 2: double (vec.clh); default 0
//   BALANCED         0: facets of X alone, 1: and about wh (facet_integral.clh); default 0
//   SLICE_SUMS       scrambles that share a vector, where they have few facets (facet_integral.clh); default 1
//   TABLE_WHOLE      0: the table is a slice, 1: it is whole (table_slice.clh); default 0
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_slice.clh); default 0
//   and what is simulated of X (effects.clh)
#include "facet_integral.clh"
#include "fresnel.clh"
#include "pairs.clh"
#include "sphere.clh"
#include "surface_masking.clh"

// Adds a part to the first `count` of W pairs, of number `at` in the buffers.
inline void integrate(__global float4 *rgba, __global float4 *errors, __global Estimate *estimates, int at, int count,
                      const Pairs *pairs, const Integral *f, const Part *part) {
    const Estimate nothing = {{(float4)(0.0f), (float4)(0.0f)}, (float4)(0.0f), (float4)(0.0f)};
    for (int k = 0; k < min(count, W); ++k) {
        Estimate e = nothing;
        if (LANE_OF_MASK(pairs->lit, k)) {
            Pair p = pair_of(pairs, k);
            if (!part_is_first(part)) e = estimates[at + k];
            add_part(&e, f, &p, part);
        }
        if (!part_is_last(part))
            estimates[at + k] = e;
        else if (LANE_OF_MASK(pairs->there, k))
            store_estimate(rgba + at + k, errors + at + k, &e, (float)LANE(pairs->factor, k), part->all_scrambles);
        else
            rgba[at + k] = errors[at + k] = (float4)(0.0f);
    }
}

// Work-item (c, r) owns pixels W c ... W c + W - 1 of row first_row + r. `theta_d` is the image's, in rows.
__kernel void integrate_sphere(__global float4 *rgba, __global float4 *errors, __global Estimate *estimates, Part part,
                               Displacement x, __global const float4 *table, __constant float *density,
                               __global const float *of_x, __global const float *about_wh, int stride, int first_row,
                               SphereView view, real theta_d) {
    int first_column = W * (int)get_global_id(0), row = (int)get_global_id(1);
    if (first_column >= view.width) return;
    SpherePoint s = sphere_point(&view, first_column + laneW, first_row + row);
    Pairs p;
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
    make_frames(&p);
    const Integral f = {x, table, density, of_x, about_wh, stride};
    integrate(rgba, errors, estimates, row * view.width + first_column, view.width - first_column, &p, &f, &part);
}

// Work-item c owns pairs W c ... W c + W - 1 of `items` from number `first`. wi and wo are [3][pairs_stride], W numbers
// longer than the pairs.
__kernel void integrate_pairs(__global float4 *rgba, __global float4 *errors, __global Estimate *estimates, Part part,
                              Displacement x, __global const float4 *table, __constant float *density,
                              __global const float *of_x, __global const float *about_wh, int stride, int first,
                              int items, __global const float *wi, __global const float *wo, int pairs_stride) {
    int item = W * (int)get_global_id(0);
    if (item >= items) return;
    PairsOfDirections d = load_pairs(wi, wo, pairs_stride, first + item);
    Pairs p;
    p.ix = d.ix;
    p.iy = d.iy;
    p.iz = d.iz;
    realW hx = d.ix + d.ox, hy = d.iy + d.oy, hz = d.iz + d.oz;
    p.there = p.lit = (d.iz > (realW)0.0f) && (d.oz > (realW)0.0f);
    realW twice_cos_d = selectW((realW)1.0f, sqrt(hx * hx + hy * hy + hz * hz), p.lit);
    p.hx = hx / twice_cos_d;
    p.hy = hy / twice_cos_d;
    p.hz = hz / twice_cos_d;
    p.cos_d = 0.5f * twice_cos_d;
    p.theta_d = difference_angle(d.ix, d.iy, d.iz, d.ox, d.oy, d.oz) * (float)TABLE_THETA_D;
    p.factor = masking_factor(&x, d.ix, d.iy, d.iz, d.ox, d.oy, d.oz, p.lit);
    make_frames(&p);
    const Integral f = {x, table, density, of_x, about_wh, stride};
    integrate(rgba, errors, estimates, item, items - item, &p, &f, &part);
}
