// Facets of X for the reference: jittered strata of X's slopes, written as unit normals with their weight.
// One work-item per sample; made once per image, so that nothing here is in the integration's loop.
#include "displacement.clh"

// A pair of uniform numbers in (0, 1) per index and seed: PCG (O'Neill 2014) output over a hashed counter.
inline uint pcg(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}
inline float uniform_open(uint bits) { return ((float)(bits >> 9) + 0.5f) * 0x1p-23f; }

// Quantile of the slope density exp(-t^2) / sqrt(pi) at tail mass q, 0 < q <= 1/2: the t <= 0 below which it lies.
// Giles 2010, "Approximating the erfinv function", single precision; relative error of erfinv 3e-7.
inline float slope_quantile(float q) {
    float x = 2.0f * q - 1.0f;
    float w = -log(4.0f * q * (1.0f - q));
    float p;
    if (w < 5.0f) {
        w -= 2.5f;
        p = 2.81022636e-08f;
        p = fma(p, w, 3.43273939e-07f);
        p = fma(p, w, -3.5233877e-06f);
        p = fma(p, w, -4.39150654e-06f);
        p = fma(p, w, 0.00021858087f);
        p = fma(p, w, -0.00125372503f);
        p = fma(p, w, -0.00417768164f);
        p = fma(p, w, 0.246640727f);
        p = fma(p, w, 1.50140941f);
    } else {
        w = sqrt(w) - 3.0f;
        p = -0.000200214257f;
        p = fma(p, w, 0.000100950558f);
        p = fma(p, w, 0.00134934322f);
        p = fma(p, w, -0.00367342844f);
        p = fma(p, w, 0.00573950773f);
        p = fma(p, w, -0.0076224613f);
        p = fma(p, w, 0.00943887047f);
        p = fma(p, w, 1.00167406f);
        p = fma(p, w, 2.83297682f);
    }
    return p * x;
}

// The sample of stratum `index` of `strata`, with its jitter in (0, 1). Counted from the nearer end, so that both
// tails keep their accuracy.
inline float stratified_slope(uint index, uint strata, float jitter) {
    bool upper = 2 * index >= strata;
    float from_end = upper ? (float)(strata - 1 - index) + (1.0f - jitter) : (float)index + jitter;
    float q = fmin(from_end / (float)strata, 0.5f);
    float t = slope_quantile(q);
    return upper ? -t : t;
}

// Samples first ... first + size - 1 of `strata_1` x `strata_2` strata along X's principal axes, facets as
// [4][stride]: m.x, m.y, m.z and 1/m.z.
__kernel void draw_slopes(__global float *facets, int stride, uint first, uint strata_1, uint strata_2, uint seed,
                          Displacement x) {
    uint at = (uint)get_global_id(0);
    uint index = first + at;
    uint hash = pcg(index ^ pcg(seed));
    float t1 = stratified_slope(index / strata_2, strata_1, uniform_open(hash));
    float t2 = stratified_slope(index % strata_2, strata_2, uniform_open(pcg(hash + 1u)));

    float d1 = sqrt(x.var_1) * t1, d2 = sqrt(x.var_2) * t2;
    float slope_x = x.mean_x + x.axis_x * d1 - x.axis_y * d2;
    float slope_y = x.mean_y + x.axis_y * d1 + x.axis_x * d2;

    float inv_mz = sqrt(1.0f + slope_x * slope_x + slope_y * slope_y);
    facets[at] = -slope_x / inv_mz;
    facets[stride + at] = -slope_y / inv_mz;
    facets[2 * stride + at] = 1.0f / inv_mz;
    facets[3 * stride + at] = inv_mz;
}
