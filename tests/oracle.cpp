#include "oracle.h"

#include <algorithm>

namespace oracle {
Gaussian gaussian(double alpha_x, double alpha_y, double rho, double mean_x, double mean_y) {
    return {mean_x, mean_y, alpha_x * alpha_x / 2.0, rho * alpha_x * alpha_y / 2.0, alpha_y * alpha_y / 2.0};
}

Gaussian widened(const Gaussian &x, double alpha) {
    Gaussian z = x;
    z.cov_xx += alpha * alpha / 2.0;
    z.cov_yy += alpha * alpha / 2.0;
    return z;
}

double exponent(const Gaussian &g, double slope_x, double slope_y) {
    const long double x = static_cast<long double>(slope_x) - g.mean_x;
    const long double y = static_cast<long double>(slope_y) - g.mean_y;
    const long double xx = g.cov_xx, xy = g.cov_xy, yy = g.cov_yy;
    const long double det = xx * yy - xy * xy;
    return static_cast<double>((yy * x * x - 2.0L * xy * x * y + xx * y * y) / (2.0L * det));
}

double p22(const Gaussian &g, double slope_x, double slope_y) {
    const double det = g.cov_xx * g.cov_yy - g.cov_xy * g.cov_xy;
    return std::exp(-exponent(g, slope_x, slope_y)) / (2.0 * pi * std::sqrt(det));
}

double ndf(const Gaussian &g, const Vec &wm) {
    if (wm.z <= 0.0) return 0.0;
    const double cos2 = wm.z * wm.z;
    return p22(g, -wm.x / wm.z, -wm.y / wm.z) / (cos2 * cos2);
}

double plane(const Gaussian &g, const Vec &k) { return k.z - k.x * g.mean_x - k.y * g.mean_y; }

// 1 + erf(v) is written erfc(-v), which does not cancel; with p > 0 both terms are positive.
double sigma(const Gaussian &g, const Vec &k) {
    const double p = plane(g, k);
    const double variance = g.cov_xx * k.x * k.x + 2.0 * g.cov_xy * k.x * k.y + g.cov_yy * k.y * k.y;
    if (variance <= 0.0) return std::max(p, 0.0);
    const double s = std::sqrt(2.0 * variance), v = p / s;
    return p * std::erfc(-v) / 2.0 + s * std::exp(-v * v) / (2.0 * std::sqrt(pi));
}

double g1(const Gaussian &g, const Vec &k) {
    const double p = plane(g, k);
    return p > 0.0 ? p / sigma(g, k) : 0.0;
}

double g2(Masking masking, double plane_i, double sigma_i, double plane_o, double sigma_o) {
    if (plane_i <= 0.0 || plane_o <= 0.0) return 0.0;
    const double g1_i = plane_i / sigma_i, g1_o = plane_o / sigma_o;
    switch (masking) {
        case Masking::separable:
            return g1_i * g1_o;
        case Masking::coinciding:
            return std::min(g1_i, g1_o);
        case Masking::correlated:
            break;
    }
    return plane_i * plane_o / (sigma_i * plane_o + sigma_o * plane_i - plane_i * plane_o);
}

double g2(Masking masking, const Gaussian &g, const Vec &wi, const Vec &wo) {
    return g2(masking, plane(g, wi), sigma(g, wi), plane(g, wo), sigma(g, wo));
}

double ndf(const Mixture &m, const Vec &wm) {
    double sum = 0.0;
    for (const Lobe &lobe : m.lobes) sum += lobe.weight * ndf(widened(m.x, lobe.alpha), wm);
    return sum;
}

double sigma(const Mixture &m, const Vec &k) {
    double sum = 0.0;
    for (const Lobe &lobe : m.lobes) sum += lobe.weight * sigma(widened(m.x, lobe.alpha), k);
    return sum;
}

double g2(Masking masking, const Mixture &m, const Vec &wi, const Vec &wo) {
    return g2(masking, plane(m.x, wi), sigma(m, wi), plane(m.x, wo), sigma(m, wo));
}

double fcos(const Mixture &m, Masking masking, const Vec &wi, const Vec &wo) {
    const double plane_o = plane(m.x, wo);
    if (wi.z <= 0.0 || wo.z <= 0.0 || plane(m.x, wi) <= 0.0 || plane_o <= 0.0) return 0.0;
    return ndf(m, half_vector(wi, wo)) * g2(masking, m, wi, wo) / (4.0 * plane_o);
}

double brdf(const Mixture &m, Masking masking, const Vec &wi, const Vec &wo) {
    const double plane_i = plane(m.x, wi);
    return plane_i > 0.0 ? fcos(m, masking, wi, wo) / plane_i : 0.0;
}

double radial_density(const std::vector<Lobe> &lobes, double slope) {
    double sum = 0.0;
    for (const Lobe &lobe : lobes) sum += lobe.weight * p22(gaussian(lobe.alpha, lobe.alpha), slope, 0.0);
    return sum;
}

} // namespace oracle
