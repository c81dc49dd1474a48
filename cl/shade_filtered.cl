// Filtered shading: the widened mixture, one evaluation per pixel or per pair of directions.
//   f cos_i = F(theta_d) D(wh) G2 / (4 p_o)        (mixture.clh)
//
// Build parameters
//   W             lanes per work-item (vec.clh); default 1
//   G2_SEPARABLE  0: height-correlated masking, 1: separable (masking.clh); default 0
#include "mixture.clh"
#include "sphere.clh"

// Writes lane values as RGBA, alpha 1, or zeros where not inside; lanes at or past `valid` are not written.
inline void store_rgba(__global float4 *out, realW value, float3 colour, intW inside, int valid) {
    float v[W];
    int in[W];
    vstoreW(value, 0, v);
    vstoreW(inside, 0, in);
    for (int lane = 0; lane < W && lane < valid; ++lane)
        out[lane] = in[lane] ? (float4)(colour * v[lane], 1.0f) : (float4)(0.0f);
}

// The sphere of the experiment: work-item (c, r) shades pixels W c ... W c + W - 1 of row first_row + r. wi, wo and so
// theta_d are one for the whole image; `fresnel` is F(theta_d).
__kernel void shade_filtered_sphere(__global float4 *rgba, SphereView view, int first_row, Displacement x,
                                    __constant Lobe *lobes, int count, float4 fresnel) {
    int first_column = W * (int)get_global_id(0);
    int band_row = (int)get_global_id(1);
    SpherePoint s = sphere_point(&view, first_column + laneW, (intW)(first_row + band_row));

    realW fcos = mixture_fcos(lobes, count, &x,
                              SPHERE_LOCAL_X(s, view.wi_x, view.wi_y), SPHERE_LOCAL_Y(s, view.wi_x, view.wi_y),
                              SPHERE_LOCAL_Z(s, view.wi_x, view.wi_y), s.ty, s.by, s.ny,
                              SPHERE_LOCAL_X(s, view.wh_x, view.wh_y), SPHERE_LOCAL_Y(s, view.wh_x, view.wh_y),
                              SPHERE_LOCAL_Z(s, view.wh_x, view.wh_y));
    store_rgba(rgba + band_row * view.width + first_column, fcos, fresnel.xyz, s.inside, view.width - first_column);
}

// Pairs of directions as structure of arrays, wi and wo each [3][stride], stride a multiple of W; `fresnel` holds
// F(theta_d) per channel and knot, [3][knots], theta_d = k pi/2 / (knots - 1), interpolated linearly; fcos is
// [3][stride].
__kernel void shade_filtered_pairs(__global float *fcos, int stride, __global const float *wi, __global const float *wo,
                                   Displacement x, __constant Lobe *lobes, int count, __global const float *fresnel,
                                   int knots) {
    int at = W * (int)get_global_id(0);
    realW ix = vloadW(0, wi + at), iy = vloadW(0, wi + stride + at), iz = vloadW(0, wi + 2 * stride + at);
    realW ox = vloadW(0, wo + at), oy = vloadW(0, wo + stride + at), oz = vloadW(0, wo + 2 * stride + at);

    // Only the half vector's slopes matter, so it need not be normalised.
    realW shape = mixture_fcos(lobes, count, &x, ix, iy, iz, ox, oy, oz, ix + ox, iy + oy, iz + oz);

    // theta_d is half the angle between wi and wo, so their chord is 2 sin(theta_d), and pi/2 at the most.
    realW chord2 = (ix - ox) * (ix - ox) + (iy - oy) * (iy - oy) + (iz - oz) * (iz - oz);
    realW sum2 = (ix + ox) * (ix + ox) + (iy + oy) * (iy + oy) + (iz + oz) * (iz + oz);
    realW theta_d = 2.0f * angle_modulo_pi(sqrt(chord2), sqrt(sum2)); // over pi/2
    realW knot = theta_d * (float)(knots - 1);
    intW below = clamp(to_intW(knot), (intW)0, (intW)(knots - 2));
    realW share = knot - to_realW(below);

    float f[W], t[W];
    int k[W];
    vstoreW(shape, 0, f);
    vstoreW(share, 0, t);
    vstoreW(below, 0, k);
    for (int channel = 0; channel < 3; ++channel)
        for (int lane = 0; lane < W; ++lane) {
            __global const float *curve = fresnel + channel * knots + k[lane];
            fcos[channel * stride + at + lane] = f[lane] * mix(curve[0], curve[1], t[lane]);
        }
}
