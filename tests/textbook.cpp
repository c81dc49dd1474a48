#include "textbook.h"

#include <cmath>

namespace test {

namespace {

constexpr float pi = 3.14159265f;

struct Angles {
    float cosine, tangent, phi;
};

Angles angles_of(float x, float y, float z) {
    const float length = std::sqrt(x * x + y * y + z * z);
    return {z / length, std::tan(std::acos(z / length)), std::atan2(y, x)};
}

float alpha_towards(float alpha_x, float alpha_y, float phi) {
    const float x = alpha_x * std::cos(phi), y = alpha_y * std::sin(phi);
    return std::sqrt(x * x + y * y);
}

float lambda(float alpha_x, float alpha_y, const Angles &k) {
    const float a = 1.0f / (alpha_towards(alpha_x, alpha_y, k.phi) * k.tangent);
    return (std::erf(a) - 1.0f) / 2.0f + std::exp(-a * a) / (2.0f * a * std::sqrt(pi));
}

float ndf(float alpha_x, float alpha_y, const Angles &m) {
    const float cos2 = m.cosine * m.cosine, tan2 = (1.0f - cos2) / cos2;
    const float c = std::cos(m.phi) / alpha_x, s = std::sin(m.phi) / alpha_y;
    return std::exp(-tan2 * (c * c + s * s)) / (pi * alpha_x * alpha_y * cos2 * cos2);
}

// The red curve of the first set.
float fresnel(const HardCase &c, float theta_d) {
    const HardCurve curve = hard_curve(c, 0, 0), knots = hard_theta_d(c);
    std::size_t k = 0;
    while (k + 2 < hard_knots && theta_d >= knots[k + 1]) ++k;
    return curve[k] + (curve[k + 1] - curve[k]) * (theta_d - knots[k]) / (knots[k + 1] - knots[k]);
}

} // namespace

std::vector<std::pair<std::size_t, double>> textbook(const HardCase &c, const HardPair &pair) {
    const auto &[ix, iy, iz] = pair.wi;
    const auto &[ox, oy, oz] = pair.wo;
    if (iz <= 0.0f || oz <= 0.0f) return {};
    const Angles i = angles_of(ix, iy, iz), o = angles_of(ox, oy, oz), h = angles_of(ix + ox, iy + oy, iz + oz);
    float d = 0.0f, lambda_i = 0.0f, lambda_o = 0.0f;
    for (const oracle::Lobe &lobe : c.lobes) {
        const auto weight = static_cast<float>(lobe.weight);
        const auto alpha_x = static_cast<float>(std::hypot(lobe.alpha, c.x.alpha_x));
        const auto alpha_y = static_cast<float>(std::hypot(lobe.alpha, c.x.alpha_y));
        d += weight * ndf(alpha_x, alpha_y, h);
        lambda_i += weight * lambda(alpha_x, alpha_y, i);
        lambda_o += weight * lambda(alpha_x, alpha_y, o);
    }
    const float g2 = 1.0f / (1.0f + lambda_i + lambda_o);
    const float cos_d = (ix * ox + iy * oy + iz * oz), theta_d = std::acos(cos_d) / 2.0f / (pi / 2.0f);
    return {{quantity_ndf, d},
            {quantity_sigma, i.cosine * (1.0f + lambda_i)},
            {quantity_lambda, lambda_i},
            {quantity_g1, 1.0f / (1.0f + lambda_i)},
            {quantity_g2, g2},
            {quantity_theta_d, theta_d},
            {quantity_shared, fresnel(c, theta_d) * d * g2 / (4.0f * i.cosine * o.cosine) * i.cosine}};
}

} // namespace test
