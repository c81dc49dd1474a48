// The reference's integral in plain C++, for one core: float, libm, -O3 -march=native and no fast-math
// (CMakeLists.txt).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "reference.h"

namespace {

constexpr float pi = std::numbers::pi_v<float>;

struct Vec {
    float x, y, z;
};

float dot(const Vec &a, const Vec &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec cross(const Vec &a, const Vec &b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

Vec normalized(const Vec &a) {
    const float length = std::sqrt(dot(a, a));
    return {a.x / length, a.y / length, a.z / length};
}

// A world direction in the frame of the normal n.
Vec local(const Vec &w, const Vec &n) {
    const Vec b = normalized({-n.y, n.x, 0.0f}), t = cross(b, n);
    return {dot(w, t), dot(w, b), dot(w, n)};
}

float sigma(const Vec &k) {
    const float sine = std::sqrt(std::max(1.0f - k.z * k.z, 0.0f)), v = k.z / (reference_alpha * sine + 1e-20f);
    return 0.5f * k.z * (1.0f + std::erf(v)) +
           reference_alpha * sine * std::exp(-v * v) * (0.5f * std::numbers::inv_sqrtpi_v<float>);
}

float g2_over_cos_o(const Vec &wi, const Vec &wo) { return wi.z / (sigma(wi) * wo.z + sigma(wo) * wi.z - wi.z * wo.z); }

// Adds weight * f, linear between the table's nodes.
void add_value(const float *table, float theta_h, float theta_d, float phi_d, float weight, float *rgb) {
    const float h = std::sqrt(theta_h / (0.5f * pi)) * 90.0f, d = theta_d / (0.5f * pi) * 90.0f,
                p = phi_d / pi * 180.0f;
    const int h0 = std::min(static_cast<int>(h), 88), d0 = std::min(static_cast<int>(d), 88),
              p0 = std::min(static_cast<int>(p), 179), p1 = (p0 + 1) % 180;
    const float fh = std::min(h - static_cast<float>(h0), 1.0f), fd = std::min(d - static_cast<float>(d0), 1.0f),
                fp = p - static_cast<float>(p0);
    for (int corner = 0; corner < 8; ++corner) {
        const int up = corner & 1, over = (corner >> 1) & 1, across = corner >> 2;
        const float share = weight * (up ? fh : 1.0f - fh) * (over ? fd : 1.0f - fd) * (across ? fp : 1.0f - fp);
        const float *node = table + 4 * (((h0 + up) * 90 + d0 + over) * 180 + (across ? p1 : p0));
        for (int c = 0; c < 3; ++c) rgb[c] += share * node[c];
    }
}

// Adds f <wi,wm> <wo,wm> G2 / (wm.z wo.z).
void add_facet(const float *table, const Vec &wi, const Vec &wo, const Vec &wm, float *rgb) {
    const float i_m = dot(wi, wm), o_m = dot(wo, wm);
    if (i_m <= 0.0f || o_m <= 0.0f) return;
    const Vec wh = normalized({wi.x + wo.x, wi.y + wo.y, wi.z + wo.z});
    const float theta_h = std::acos(std::clamp(dot(wh, wm), -1.0f, 1.0f));
    const float theta_d = std::acos(std::clamp(dot(wi, wh), -1.0f, 1.0f));
    const Vec across = cross(wm, wh), side = cross(wi, wh);
    float phi_d = std::atan2(dot(cross(across, wh), side), dot(across, side));
    if (phi_d < 0.0f) phi_d += pi;
    add_value(table, theta_h, theta_d, phi_d, i_m * o_m / wm.z * g2_over_cos_o(wi, wo), rgb);
}

// A facet of X, from two numbers between 0 and 1.
Vec facet_of_x(float u1, float u2) {
    const float radius = reference_alpha * std::sqrt(-std::log(u1)), turn = 2.0f * pi * u2;
    return normalized({-radius * std::cos(turn), -radius * std::sin(turn), 1.0f});
}

} // namespace

PlainResult reference_scalar(const std::vector<float> &table, std::uint32_t seed) {
    std::minstd_rand random(seed);
    const auto uniform = [&random] { return static_cast<float>(random() >> 7) * 0x1p-24f + 0x1p-25f; };
    const Vec light = {std::cos(reference_light_phi), std::sin(reference_light_phi), 0.0f}, view = {0.0f, 1.0f, 0.0f};
    double green = 0.0;
    const auto start = std::chrono::steady_clock::now();
    for (int row = 0; row < reference_side; ++row)
        for (int column = 0; column < reference_side; ++column) {
            const float x = static_cast<float>(2 * column + 1 - reference_side) / reference_side;
            const float z = static_cast<float>(reference_side - 1 - 2 * row) / reference_side;
            if (x * x + z * z >= 1.0f) continue;
            const Vec n = {x, std::sqrt(1.0f - x * x - z * z), z};
            const Vec wi = local(light, n), wo = local(view, n);
            if (wi.z <= 0.0f) continue;
            float rgb[3] = {0.0f, 0.0f, 0.0f};
            for (int k = 0; k < plain_samples; ++k) {
                const float u1 = uniform(), u2 = uniform();
                add_facet(table.data(), wi, wo, facet_of_x(u1, u2), rgb);
            }
            green += static_cast<double>(rgb[1]);
        }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return {seconds, green / (1.0 * reference_side * reference_side * plain_samples)};
}
