// Facets for the reference, drawn once per image, so that nothing here is in the integration's loop. One work-item per
// facet: number first + its own, of `size`.
#include "displacement.clh"
#include "proposal.clh"
#include "quantile.clh"
#include "random.clh"

// Facets of X are kept as [5][stride]: the unit normal's x, y, z, then 1/z, then its density over solid angle.
inline void store_facet_of_x(__global float *facets, int stride, uint at, Displacement x, float t1, float t2) {
    float d1 = sqrt(x.var_1) * t1, d2 = sqrt(x.var_2) * t2;
    float slope_x = x.mean_x + x.axis_x * d1 - x.axis_y * d2;
    float slope_y = x.mean_y + x.axis_y * d1 + x.axis_x * d2;
    float inv_mz = sqrt(1.0f + slope_x * slope_x + slope_y * slope_y);
    facets[at] = -slope_x / inv_mz;
    facets[stride + at] = -slope_y / inv_mz;
    facets[2 * stride + at] = 1.0f / inv_mz;
    facets[3 * stride + at] = inv_mz;

    // Only asked for where X has both variances.
    float peak = 1.0f / (M_PI_F * sqrt(x.var_1) * sqrt(x.var_2));
    facets[4 * stride + at] = peak * exp(-t1 * t1 - t2 * t2) * inv_mz * inv_mz * inv_mz;
}

// Jittered strata, strata_1 x strata_2 along X's principal axes; samples first, first + 1, ...
__kernel void draw_grid(__global float *facets, int stride, uint first, uint size, uint seed, Displacement x,
                        uint strata_1, uint strata_2) {
    uint at = (uint)get_global_id(0);
    if (at >= size) return;
    uint index = first + at;
    uint hash = pcg(index ^ pcg(seed));
    float t1 = slope_at(index / strata_2, strata_1, uniform_open(hash));
    float t2 = slope_at(index % strata_2, strata_2, uniform_open(pcg(hash + 1u)));
    store_facet_of_x(facets, stride, at, x, t1, t2);
}

// Scrambled Sobol points through the slopes' quantiles.
__kernel void draw_sobol(__global float *facets, int stride, uint first, uint size, uint seed, Displacement x) {
    uint at = (uint)get_global_id(0);
    if (at >= size) return;
    uint2 bits = sobol_bits(first + at, seed);
    // The high half says where among 2^16 strata, the low half where within it: 32 bits where a float holds 24.
    float t1 = slope_at(bits.x >> 16, 65536u, uniform_open(bits.x << 16));
    float t2 = slope_at(bits.y >> 16, 65536u, uniform_open(bits.y << 16));
    store_facet_of_x(facets, stride, at, x, t1, t2);
}

// Facets of the base about +z from scrambled Sobol points, [4][stride]: x, y and z - 1 of the unit normal, then the
// tabulated density over the true one. `lobes` holds (cumulated weight, alpha) of a mixture of `count` lobes.
__kernel void draw_about_z(__global float *facets, int stride, uint first, uint size, uint seed,
                           __constant float2 *lobes, int count, __constant float *density) {
    uint at = (uint)get_global_id(0);
    if (at >= size) return;
    uint2 bits = sobol_bits(first + at, seed);

    // Choose the lobe by the first number, and use what is left of it within the lobe.
    float u = uniform_open(bits.x);
    int k = 0;
    while (k < count - 1 && u >= lobes[k].x) ++k;
    float before = k > 0 ? lobes[k - 1].x : 0.0f, share = lobes[k].x - before;
    float within = clamp((u - before) / share, 0x1p-25f, 1.0f - 0x1p-24f); // rounding may reach either end

    // Draw the slope, then its normal; z - 1 in the form that does not cancel.
    float tangent2 = -log1p(-within) * lobes[k].y * lobes[k].y;
    float tangent = sqrt(tangent2), phi = 2.0f * M_PI_F * uniform_open(bits.y);
    float length = sqrt(1.0f + tangent2), z_1 = -tangent2 / (length * (1.0f + length));
    facets[at] = tangent * cos(phi) / length;
    facets[stride + at] = tangent * sin(phi) / length;
    facets[2 * stride + at] = z_1;

    float p = 0.0f;
    for (int j = 0; j < count; ++j) {
        float weight = lobes[j].x - (j > 0 ? lobes[j - 1].x : 0.0f), alpha2 = lobes[j].y * lobes[j].y;
        p += weight / (M_PI_F * alpha2) * exp(-tangent2 / alpha2);
    }
    float row = sqrt(atan(tangent) * (2.0f / M_PI_F)) * (float)SLICE_ROWS;
    int below = clamp((int)row, 0, PROPOSAL_ROWS - 2);
    float tabulated = mix(density[below], density[below + 1], row - (float)below);
    facets[3 * stride + at] = tabulated / (p * length * length * length);
}
