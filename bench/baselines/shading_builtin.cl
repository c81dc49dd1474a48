// A baseline of the shading benchmarks: the same formulas written plainly, one pixel per work-item, with built-in
// functions. Lit from the viewer: wi = wo.

typedef struct {
    float weight, alpha;
    float fresnel[3];
} Lobe;

inline float sigma(float alpha2_x, float alpha2_y, float3 k) {
    float s = sqrt(alpha2_x * k.x * k.x + alpha2_y * k.y * k.y);
    if (s == 0.0f) return k.z;
    float v = k.z / s;
    return 0.5f * k.z * (1.0f + erf(v)) + s * exp(-v * v) * 0.28209479f;
}

inline float g2_over_cos_o(float cos_i, float cos_o, float sigma_i, float sigma_o) {
    return cos_i / (sigma_i * cos_o + sigma_o * cos_i - cos_i * cos_o);
}

__kernel void shading_builtin(__global float4 *rgba, int side, float alpha_x, float alpha_y, __constant Lobe *lobes,
                              int count, int per_lobe) {
    int column = (int)get_global_id(0), row = (int)get_global_id(1);
    float x = (float)(2 * column + 1 - side) / (float)side, z = (float)(side - 1 - 2 * row) / (float)side;
    float4 pixel = (float4)(0.0f);
    if (x * x + z * z < 1.0f) {
        float y = sqrt(1.0f - x * x - z * z), sin_theta = sqrt(1.0f - z * z);
        float3 wi = (float3)(z * y / sin_theta, x / sin_theta, y), wo = wi, h = wi + wo;
        float slope_x = -h.x / h.z, slope_y = -h.y / h.z;
        float inv_cos2 = 1.0f + slope_x * slope_x + slope_y * slope_y;
        float p22_sum = 0.0f, sigma_i_sum = 0.0f, sigma_o_sum = 0.0f;
        float3 rgb = (float3)(0.0f);
        for (int k = 0; k < count; ++k) {
            float alpha2_x = lobes[k].alpha * lobes[k].alpha + alpha_x * alpha_x;
            float alpha2_y = lobes[k].alpha * lobes[k].alpha + alpha_y * alpha_y;
            float p22 = exp(-slope_x * slope_x / alpha2_x - slope_y * slope_y / alpha2_y) /
                        (M_PI_F * sqrt(alpha2_x * alpha2_y));
            float sigma_i = sigma(alpha2_x, alpha2_y, wi), sigma_o = sigma(alpha2_x, alpha2_y, wo);
            if (per_lobe)
                rgb += (float3)(lobes[k].fresnel[0], lobes[k].fresnel[1], lobes[k].fresnel[2]) * p22 *
                       g2_over_cos_o(wi.z, wo.z, sigma_i, sigma_o);
            p22_sum += lobes[k].weight * p22;
            sigma_i_sum += lobes[k].weight * sigma_i;
            sigma_o_sum += lobes[k].weight * sigma_o;
        }
        if (!per_lobe)
            rgb = (float3)(lobes[0].fresnel[0], lobes[0].fresnel[1], lobes[0].fresnel[2]) * p22_sum *
                  g2_over_cos_o(wi.z, wo.z, sigma_i_sum, sigma_o_sum);
        pixel = (float4)(0.25f * inv_cos2 * inv_cos2 * rgb, 1.0f);
    }
    rgba[row * side + column] = pixel;
}
