// Facets for the reference, drawn once per image, so that nothing here is in the integration's loop. One work-item per
// slot of the buffers.
#include "displacement.clh"
#include "part.clh"
#include "proposal.clh"
#include "quantile.clh"
#include "random.clh"

// What a slot is for.
typedef struct {
    int wanted;
    uint at;           // its place
    uint number, seed; // of the facet in its scramble, and the scramble's
} Slot;

inline Slot slot_of(int at, const Part *part, __constant const uint *seeds) {
    int scramble = at / part->slots, within = at % part->slots;
    Slot s;
    s.wanted = scramble < part->scrambles && within < part->size;
    s.at = (uint)at;
    s.number = (uint)(part->first + within);
    s.seed = s.wanted ? seeds[part->scramble + scramble] : 0u;
    return s;
}

// Facets of X are kept as [5][stride]: the unit normal's x, y, z, then D_X over their density over solid angle, and
// that density.
inline void store_facet_of_x(__global float *facets, int stride, uint at, Displacement x, DrawnSlope along_1,
                             DrawnSlope along_2) {
    float t1 = along_1.t, t2 = along_2.t, d1 = sqrt(x.var_1) * t1, d2 = sqrt(x.var_2) * t2;
    float slope_x = x.mean_x + x.axis_x * d1 - x.axis_y * d2;
    float slope_y = x.mean_y + x.axis_y * d1 + x.axis_x * d2;
    float inv_mz = sqrt(1.0f + slope_x * slope_x + slope_y * slope_y);
    facets[at] = -slope_x / inv_mz;
    facets[stride + at] = -slope_y / inv_mz;
    facets[2 * stride + at] = 1.0f / inv_mz;
    facets[3 * stride + at] = along_1.weight * along_2.weight * inv_mz;

    // Only asked for where X has both variances.
    float peak = 1.0f / (M_PI_F * sqrt(x.var_1) * sqrt(x.var_2));
    facets[4 * stride + at] = peak * inv_mz * inv_mz * inv_mz * exp(-t1 * t1 - t2 * t2);
}

// Jittered strata, strata_1 x strata_2 along X's principal axes. On a line they are graded: the last of equal strata,
// which has all of the tail, would leave most of the error, and skew it. Over a plane weights cost more than that: two
// axes' products are not stratified.
__kernel void draw_grid(__global float *facets, int stride, Part part, __constant uint *seeds, Displacement x,
                        uint strata_1, uint strata_2) {
    Slot s = slot_of((int)get_global_id(0), &part, seeds);
    if (!s.wanted) return;
    uint hash = pcg(s.number ^ pcg(s.seed));
    uint graded_1 = strata_2 == 1u ? strata_1 / 8 : 0u, graded_2 = strata_1 == 1u ? strata_2 / 8 : 0u;
    DrawnSlope along_1 = slope_at(s.number / strata_2, strata_1, graded_1, uniform_open(hash));
    DrawnSlope along_2 = slope_at(s.number % strata_2, strata_2, graded_2, uniform_open(pcg(hash + 1u)));
    store_facet_of_x(facets, stride, s.at, x, along_1, along_2);
}

// Scrambled Sobol points through the slopes' quantiles.
__kernel void draw_sobol(__global float *facets, int stride, Part part, __constant uint *seeds, Displacement x) {
    Slot s = slot_of((int)get_global_id(0), &part, seeds);
    if (!s.wanted) return;
    uint2 bits = sobol_bits(s.number, s.seed);
    // The high half says where among 2^16 strata, the low half where within it: 32 bits where a float holds 24.
    DrawnSlope along_1 = slope_at(bits.x >> 16, 65536u, 0u, uniform_open(bits.x << 16));
    DrawnSlope along_2 = slope_at(bits.y >> 16, 65536u, 0u, uniform_open(bits.y << 16));
    store_facet_of_x(facets, stride, s.at, x, along_1, along_2);
}

// Facets of the base about +z from scrambled Sobol points, [4][stride]: x, y and z - 1 of the unit normal, then the
// tabulated density over the true one. `lobes` holds (cumulated weight, alpha) of a mixture of `count` lobes.
__kernel void draw_about_z(__global float *facets, int stride, Part part, __constant uint *seeds,
                           __constant float2 *lobes, int count, __constant float *density) {
    Slot s = slot_of((int)get_global_id(0), &part, seeds);
    if (!s.wanted) return;
    uint at = s.at;
    uint2 bits = sobol_bits(s.number, s.seed);

    // Draw the slope, then its normal; z - 1 in the form that does not cancel.
    float tangent2 = mixture_slope2(lobes, count, uniform_open(bits.x));
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
    float node = sqrt(atan(tangent) * (2.0f / M_PI_F)) * (float)(PROPOSAL_NODES - 1);
    int below = clamp((int)node, 0, PROPOSAL_NODES - 2);
    float tabulated = mix(density[below], density[below + 1], node - (float)below);
    facets[3 * stride + at] = tabulated / (p * length * length * length);
}
