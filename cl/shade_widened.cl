// Filtered shading beyond the closed form: every lobe widened by its order (widen.clh), one pixel or pair per lane.
//
// Build parameters
//   W             lanes per work-item (vec.clh); default 1
//   GRADE         0: precise, 1: fast, 2: double (vec.clh); default 0
//   PER_LOBE      0: shared model, 1: per-lobe model (mixture.clh); default 0
//   and what is simulated (effects.clh)
//   WIDENING      axes along which X is rough, 1 or 2 (facet_chart.clh); default 2
#ifndef WIDENING
#define WIDENING 2
#endif

#include "packed.clh"
#include "pairs.clh"
#include "sphere.clh"
#include "strided.clh"
#include "widened_fcos.clh"

// The sphere of the experiment, as in shade_filtered.cl. Adds to `unsettled` the visible pixels that have a lobe whose
// peak the Newton steps did not settle.
__kernel void shade_widened_sphere(__global float4 *rgba, SphereView view, int first_row, Displacement x,
                                   __constant Lobe *lobes, int count, __constant real4 *fresnel, FacetDensity facets,
                                   __constant QuadratureLobe *orders, __constant HermiteNode *nodes,
                                   __global int *unsettled) {
    int first_column = W * (int)get_global_id(0);
    int band_row = (int)get_global_id(1);
    RgbW fcos = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
    intW inside = (intW)0;
    if (sphere_meets(&view, first_column, first_row + band_row)) {
        SpherePoint s = sphere_point(&view, first_column + laneW, first_row + band_row);
        inside = s.inside;
        realW ix = SPHERE_LOCAL_X(s, view.wi_x, view.wi_y), iy = SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y);
        realW iz = SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y);
        Evaluation e = evaluation(&x, ix, iy, iz, s.ox, s.oy, s.oz, SPHERE_LOCAL_X(s, view.wh_x, view.wh_y),
                                  SPHERE_LOCAL_Y(s, view.wh_x, view.wh_y), SPHERE_LOCAL_Z(s, view.wh_x, view.wh_y));
        e.visible = e.visible && s.inside;
        if (anyW(e.visible)) {
            Quadrature q = quadrature(&facets, orders, nodes, &e, ix, iy, iz, s.ox, s.oy, s.oz);
#if PER_LOBE
            for (int k = 0; k < count; ++k)
                fcos = add_coloured(fcos, (realW)fresnel[k].x, (realW)fresnel[k].y, (realW)fresnel[k].z,
                                    widened_lobe(lobes, count, k, &e, &q));
#else
            fcos = add_coloured(fcos, (realW)fresnel[0].x, (realW)fresnel[0].y, (realW)fresnel[0].z,
                                widened_mixture(lobes, count, &e, &q));
#endif
            fcos = scaled(fcos, visible_quarter(&e));
            int lanes = lanes_of(q.unsettled && e.visible);
            if (lanes > 0) atomic_add(unsettled, lanes);
        }
    }
    store_rgba(rgba + band_row * view.width + first_column, fcos, inside, view.width - first_column);
}

// Pairs of directions, as in shade_filtered.cl.
__kernel void shade_widened_pairs(__global float *fcos_x, __global float *fcos_y, __global float *fcos_z,
                                  Places fcos_at, __global const float *wi_x, __global const float *wi_y,
                                  __global const float *wi_z, Places wi_at, __global const float *wo_x,
                                  __global const float *wo_y, __global const float *wo_z, Places wo_at, int pairs,
                                  Displacement x, __constant Lobe *lobes, int count, __global const float *packed,
                                  FacetDensity facets, __constant QuadratureLobe *orders,
                                  __constant HermiteNode *nodes) {
    int at = W * (int)get_global_id(0);
    if (at >= pairs) return;
    VectorW wi = load_vectors(wi_x, wi_y, wi_z, wi_at, at, pairs),
            wo = load_vectors(wo_x, wo_y, wo_z, wo_at, at, pairs);
    Evaluation e = evaluation_of(&x, wi, wo);
    Quadrature q = quadrature(&facets, orders, nodes, &e, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z);
    Curves curves = packed_curves(packed);
    KnotPosition knot = knot_of(&curves, wi, wo);

    RgbW fcos = widened_fcos_of_pair(lobes, count, &curves, &knot, &e, &q);
    VectorW out = {fcos.r, fcos.g, fcos.b};
    store_vectors(out, fcos_x, fcos_y, fcos_z, fcos_at, at, pairs);
}

// What lobe k of `count` is by its j-th order, orders[j count + k], at W pairs of directions: work-item (c, j count +
// k) writes values[j count + k][W c ...], without Fresnel factor. For the choice of an order (lib/choose_orders.cpp).
__kernel void probe_widening(__global float *values, int stride, __global const float *wi, __global const float *wo,
                             Displacement x, __constant Lobe *lobes, int count, FacetDensity facets,
                             __constant QuadratureLobe *orders, __constant HermiteNode *nodes) {
    int at = W * (int)get_global_id(0), entry = (int)get_global_id(1);
    int k = entry % count;
    if (at >= stride) return;
    PairsOfDirections d = load_pairs(wi, wo, stride, at);
    Evaluation e = evaluation(&x, d.ix, d.iy, d.iz, d.ox, d.oy, d.oz, d.ix + d.ox, d.iy + d.oy, d.iz + d.oz);
    Quadrature q = quadrature(&facets, orders + entry - k, nodes, &e, d.ix, d.iy, d.iz, d.ox, d.oy, d.oz);
#if PER_LOBE
    realW value = widened_lobe(lobes, count, k, &e, &q);
#else
    realW value;
    if (q.lobes[k].order == 0)
        value = ndf_of(add_p22((realW)0.0f, lobe_at(lobes, k), &e.h), &e.h) * mixture_g2(lobes, count, &e);
    else
        value = q.g2 * lobe_integral(&facets, &q.at, q.lobes + k, lobes, count, nodes, &q.unsettled);
#endif
    store_floatsW(value * visible_quarter(&e), 0, values + entry * stride + at);
}
