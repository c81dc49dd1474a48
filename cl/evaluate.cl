// What a renderer asks of a widened mixture beside f cos (shade_filtered.cl): densities and draws of directions, and
// the microsurface's own quantities. Arrays are strided (strided.clh). The lobes' weights are, of `pdf` and `sample`,
// the shares of what is drawn, and else those of the microsurface (packed.clh).
//
// Build parameters
//   W             lanes per work-item (vec.clh); default 1
//   GRADE         0: precise, 1: fast, 2: double (vec.clh); default 0
//   PER_LOBE      0: shared model, 1: per-lobe model (mixture.clh); default 0
//   and what is simulated (effects.clh)
#include "fcos.clh"
#include "strided.clh"
#include "visible_normals.clh"

__kernel void evaluate_pdf(__global float *pdf, Place pdf_at, __global const float *wi_x, __global const float *wi_y,
                           __global const float *wi_z, Places wi_at, __global const float *wo_x,
                           __global const float *wo_y, __global const float *wo_z, Places wo_at, int pairs,
                           Displacement x, __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    if (at >= pairs) return;
    VectorW wi = load_vectors(wi_x, wi_y, wi_z, wi_at, at, pairs),
            wo = load_vectors(wo_x, wo_y, wo_z, wo_at, at, pairs);
    Viewer v = viewer(&x, wo);
    store_strided(drawn_density(&x, lobes, count, PER_LOBE, &v, wi, wo), pdf, pdf_at, at, pairs);
}

// u holds the uniform numbers of the lobe and of its facet, two. Where wo sees nothing the density is 0.
__kernel void evaluate_sample(__global float *wi_x, __global float *wi_y, __global float *wi_z, Places wi_at,
                              __global float *pdf, Place pdf_at, __global const float *u_x, __global const float *u_y,
                              __global const float *u_z, Places u_at, __global const float *wo_x,
                              __global const float *wo_y, __global const float *wo_z, Places wo_at, int pairs,
                              Displacement x, __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    if (at >= pairs) return;
    VectorW u = load_vectors(u_x, u_y, u_z, u_at, at, pairs), wo = load_vectors(wo_x, wo_y, wo_z, wo_at, at, pairs);
    Viewer v = viewer(&x, wo);
    VectorW wi = drawn_direction(&x, lobes, count, PER_LOBE, &v, wo, u);
    store_vectors(wi, wi_x, wi_y, wi_z, wi_at, at, pairs);
    store_strided(drawn_density(&x, lobes, count, PER_LOBE, &v, wi, wo), pdf, pdf_at, at, pairs);
}

// Distribution of normals; wh need not be normalised. 0 below the surface.
__kernel void evaluate_ndf(__global float *ndf, Place ndf_at, __global const float *wh_x, __global const float *wh_y,
                           __global const float *wh_z, Places wh_at, int vectors, Displacement x,
                           __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    if (at >= vectors) return;
    VectorW wh = load_vectors(wh_x, wh_y, wh_z, wh_at, at, vectors);
    intW up = wh.z > (realW)0.0f;
    Tilted h = tilted(&x, wh.x, wh.y, selectW((realW)1.0f, wh.z, up));
    store_strided(selectW((realW)0.0f, mixture_ndf(lobes, count, &h), up), ndf, ndf_at, at, vectors);
}

// Projected area of the microsurface, of what is seen, towards k.
__kernel void evaluate_sigma(__global float *sigma, Place sigma_at, __global const float *k_x,
                             __global const float *k_y, __global const float *k_z, Places k_at, int vectors,
                             Displacement x, __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    if (at >= vectors) return;
    VectorW v = load_vectors(k_x, k_y, k_z, k_at, at, vectors);
    Slanted k = slanted_towards(&x, v.x, v.y, v.z);
    store_strided(mixture_sigma(lobes, count, &k), sigma, sigma_at, at, vectors);
}

// Masking: share of the facets turned towards k that is seen from there.
__kernel void evaluate_g1(__global float *g1, Place g1_at, __global const float *k_x, __global const float *k_y,
                          __global const float *k_z, Places k_at, int vectors, Displacement x, __constant Lobe *lobes,
                          int count) {
    int at = W * (int)get_global_id(0);
    if (at >= vectors) return;
    VectorW v = load_vectors(k_x, k_y, k_z, k_at, at, vectors);
    Slanted k = slanted_towards(&x, v.x, v.y, v.z);
    store_strided(mixture_g1(lobes, count, &k), g1, g1_at, at, vectors);
}

// Share that is seen from both; 0 where either direction is below the surface or its mean plane.
__kernel void evaluate_g2(__global float *g2, Place g2_at, __global const float *wi_x, __global const float *wi_y,
                          __global const float *wi_z, Places wi_at, __global const float *wo_x,
                          __global const float *wo_y, __global const float *wo_z, Places wo_at, int pairs,
                          Displacement x, __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    if (at >= pairs) return;
    VectorW wi = load_vectors(wi_x, wi_y, wi_z, wi_at, at, pairs),
            wo = load_vectors(wo_x, wo_y, wo_z, wo_at, at, pairs);
    Evaluation e = evaluation_of(&x, wi, wo);
    realW both = mixture_g2(lobes, count, &e) * e.o.p;
    store_strided(selectW((realW)0.0f, both, e.visible), g2, g2_at, at, pairs);
}
