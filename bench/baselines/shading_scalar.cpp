// The shading formulas in plain C++, for one core: float, libm's exp and erf, -O3 -march=native and no fast-math
// (bench/CMakeLists.txt).
#include <chrono>
#include <cmath>
#include <numbers>

#include "shading.h"

namespace {

struct Vec {
    float x, y, z;
};

float sigma(float alpha2_x, float alpha2_y, const Vec &k) {
    const float s = std::sqrt(alpha2_x * k.x * k.x + alpha2_y * k.y * k.y);
    if (s == 0.0f) return k.z;
    const float v = k.z / s;
    return 0.5f * k.z * (1.0f + std::erf(v)) + s * std::exp(-v * v) * (0.5f * std::numbers::inv_sqrtpi_v<float>);
}

float g2_over_cos_o(float cos_i, float cos_o, float sigma_i, float sigma_o) {
    return cos_i / (sigma_i * cos_o + sigma_o * cos_i - cos_i * cos_o);
}

// f cos_i into rgb.
void shade(const ShadingCase &what, const Vec &wi, const Vec &wo, float *rgb) {
    const Vec h = {wi.x + wo.x, wi.y + wo.y, wi.z + wo.z};
    const float slope_x = -h.x / h.z, slope_y = -h.y / h.z;
    const float inv_cos2 = 1.0f + slope_x * slope_x + slope_y * slope_y;
    float p22_sum = 0.0f, sigma_i_sum = 0.0f, sigma_o_sum = 0.0f;
    for (const ShadingLobe &lobe : what.lobes) {
        const float alpha2_x = lobe.alpha * lobe.alpha + shading_alpha_x * shading_alpha_x;
        const float alpha2_y = lobe.alpha * lobe.alpha + shading_alpha_y * shading_alpha_y;
        const float p22 = std::exp(-slope_x * slope_x / alpha2_x - slope_y * slope_y / alpha2_y) /
                          (std::numbers::pi_v<float> * std::sqrt(alpha2_x * alpha2_y));
        const float sigma_i = sigma(alpha2_x, alpha2_y, wi), sigma_o = sigma(alpha2_x, alpha2_y, wo);
        if (what.per_lobe) {
            const float value = 0.25f * p22 * inv_cos2 * inv_cos2 * g2_over_cos_o(wi.z, wo.z, sigma_i, sigma_o);
            for (int c = 0; c < 3; ++c) rgb[c] += lobe.fresnel[c] * value;
        }
        p22_sum += lobe.weight * p22;
        sigma_i_sum += lobe.weight * sigma_i;
        sigma_o_sum += lobe.weight * sigma_o;
    }
    if (what.per_lobe) return;
    const float value = 0.25f * p22_sum * inv_cos2 * inv_cos2 * g2_over_cos_o(wi.z, wo.z, sigma_i_sum, sigma_o_sum);
    for (int c = 0; c < 3; ++c) rgb[c] = what.lobes[0].fresnel[c] * value;
}

// wi = wo = (0, 1, 0) in the frame of the pixel at (x, z).
Vec local_view(float x, float z) {
    const float y = std::sqrt(1.0f - x * x - z * z), sin_theta = std::sqrt(1.0f - z * z);
    return {z * y / sin_theta, x / sin_theta, y};
}

} // namespace

ShadingResult shade_scalar(const ShadingCase &what) {
    ShadingResult result{0.0, std::vector<float>(4 * shading_side * shading_side)};
    const auto start = std::chrono::steady_clock::now();
    for (int row = 0; row < shading_side; ++row)
        for (int column = 0; column < shading_side; ++column) {
            const float x = static_cast<float>(2 * column + 1 - shading_side) / shading_side;
            const float z = static_cast<float>(shading_side - 1 - 2 * row) / shading_side;
            if (x * x + z * z >= 1.0f) continue;
            float *pixel = result.rgba.data() + 4 * (row * shading_side + column);
            const Vec view = local_view(x, z);
            shade(what, view, view, pixel);
            pixel[3] = 1.0f;
        }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}
