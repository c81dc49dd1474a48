// Filtered shading: the widened lobes, one evaluation per pixel or per pair of directions (mixture.clh).
//
// Build parameters
//   W             lanes per work-item (vec.clh); default 1
//   GRADE         0: precise, 1: fast, 2: double (vec.clh); default 0
//   PER_LOBE      0: shared model, 1: per-lobe model (mixture.clh); default 0
//   and what is simulated (effects.clh)
#include "fcos.clh"
#include "packed.clh"
#include "sphere.clh"
#include "strided.clh"

// f cos_i where F is one number per curve and channel.
inline RgbW fcos_at_one_angle(__constant const Lobe *lobes, int count, __constant const real4 *fresnel,
                              const Evaluation *e) {
    RgbW sum = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
#if PER_LOBE
    for (int k = 0; k < count; ++k)
        sum = add_coloured(sum, (realW)fresnel[k].x, (realW)fresnel[k].y, (realW)fresnel[k].z,
                           lobe_value(lobe_at(lobes, k), e));
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

// Pairs of directions: fcos, wi and wo as strided arrays (strided.clh), `packed` the material (packed.clh).
__kernel void shade_filtered_pairs(__global float *fcos_x, __global float *fcos_y, __global float *fcos_z,
                                   Places fcos_at, __global const float *wi_x, __global const float *wi_y,
                                   __global const float *wi_z, Places wi_at, __global const float *wo_x,
                                   __global const float *wo_y, __global const float *wo_z, Places wo_at, int pairs,
                                   Displacement x, __constant Lobe *lobes, int count, __global const float *packed) {
    int at = W * (int)get_global_id(0);
    if (at >= pairs) return;
    VectorW wi = load_vectors(wi_x, wi_y, wi_z, wi_at, at, pairs),
            wo = load_vectors(wo_x, wo_y, wo_z, wo_at, at, pairs);
    Evaluation e = evaluation_of(&x, wi, wo);
    Curves curves = packed_curves(packed);
    KnotPosition knot = knot_of(&curves, wi, wo);

    RgbW fcos = fcos_of_pair(lobes, count, PER_LOBE, &curves, &knot, &e);
    VectorW out = {fcos.r, fcos.g, fcos.b};
    store_vectors(out, fcos_x, fcos_y, fcos_z, fcos_at, at, pairs);
}
