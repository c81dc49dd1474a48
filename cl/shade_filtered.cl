// Filtered shading: the widened lobes, one evaluation per pixel or per pair of directions (mixture.clh).
//
// Build parameters
//   W             lanes per work-item (vec.clh); default 1
//   GRADE         0: precise, 1: fast, 2: double (vec.clh); default 0
//   PER_LOBE      0: shared model, 1: per-lobe model (mixture.clh); default 0
//   and what is simulated (effects.clh)
#include "fcos.clh"
#include "pairs.clh"
#include "sphere.clh"

// f cos_i where F is one number per curve and channel.
inline RgbW fcos_at_one_angle(__constant const Lobe *lobes, int count, __constant const real4 *fresnel,
                              const Evaluation *e) {
    RgbW sum = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
#if PER_LOBE
    for (int k = 0; k < count; ++k)
        sum =
            add_coloured(sum, (realW)fresnel[k].x, (realW)fresnel[k].y, (realW)fresnel[k].z, lobe_value(lobes + k, e));
#else
    sum =
        add_coloured(sum, (realW)fresnel[0].x, (realW)fresnel[0].y, (realW)fresnel[0].z, shared_value(lobes, count, e));
#endif
    return scaled(sum, common_factor(e));
}

// The sphere of the experiment: work-item (c, r) shades pixels W c ... W c + W - 1 of row first_row + r. wi, wo and so
// theta_d are one for the whole image; `fresnel` holds F(theta_d), one entry or one per lobe.
__kernel void shade_filtered_sphere(__global float4 *rgba, SphereView view, int first_row, Displacement x,
                                    __constant Lobe *lobes, int count, __constant real4 *fresnel) {
    int first_column = W * (int)get_global_id(0);
    int band_row = (int)get_global_id(1);
    RgbW fcos = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
    intW inside = (intW)0;
    if (sphere_meets(&view, first_column, first_row + band_row)) {
        SpherePoint s = sphere_point(&view, first_column + laneW, first_row + band_row);
        inside = s.inside;
        Evaluation e = evaluation(&x, SPHERE_LOCAL_X(s, view.wi_x, view.wi_y), SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y),
                                  SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y), s.ox, s.oy, s.oz,
                                  SPHERE_LOCAL_X(s, view.wh_x, view.wh_y), SPHERE_LOCAL_Y(s, view.wh_x, view.wh_y),
                                  SPHERE_LOCAL_Z(s, view.wh_x, view.wh_y));
        if (anyW(e.visible)) fcos = fcos_at_one_angle(lobes, count, fresnel, &e);
    }
    store_rgba(rgba + band_row * view.width + first_column, fcos, inside, view.width - first_column);
}

// Pairs of directions as structure of arrays: wi, wo and fcos each [3][stride], stride a multiple of W. `curves` holds
// one set of Fresnel curves or one per lobe (fresnel.clh), over the knots `theta_d`.
__kernel void shade_filtered_pairs(__global float *fcos, int stride, __global const float *wi, __global const float *wo,
                                   Displacement x, __constant Lobe *lobes, int count, __global const float *curves,
                                   __constant float *theta_d, int knots) {
    int at = W * (int)get_global_id(0);
    if (at >= stride) return;
    PairsOfDirections d = load_pairs(wi, wo, stride, at);
    Evaluation e = evaluation(&x, d.ix, d.iy, d.iz, d.ox, d.oy, d.oz, d.ix + d.ox, d.iy + d.oy, d.iz + d.oz);
    KnotPosition knot = knot_position(theta_d, knots, difference_angle(d.ix, d.iy, d.iz, d.ox, d.oy, d.oz));

    RgbW sum = fcos_of_pair(lobes, count, curves, knots, &knot, &e);
    store_floatsW(sum.r, 0, fcos + at);
    store_floatsW(sum.g, 0, fcos + stride + at);
    store_floatsW(sum.b, 0, fcos + 2 * stride + at);
}
