#include "oracle.h"

#include <algorithm>

namespace oracle {
Gaussian gaussian(double alpha_x, double alpha_y, double rho, double mean_x, double mean_y) {
    return gaussian_of(alpha_x, alpha_y, rho, mean_x, mean_y);
}

Gaussian widened(const Gaussian &x, double alpha) { return widened_by(x, alpha); }

namespace {

using Wide = long double;

GaussianOf<Wide> wide(const Gaussian &g) { return {g.mean_x, g.mean_y, g.cov_xx, g.cov_xy, g.cov_yy}; }
VecOf<Wide> wide(const Vec &v) { return {v.x, v.y, v.z}; }

} // namespace

double exponent(const Gaussian &g, double slope_x, double slope_y) {
    return static_cast<double>(exponent<Wide>(wide(g), slope_x, slope_y));
}

double p22(const Gaussian &g, double slope_x, double slope_y) {
    return static_cast<double>(p22<Wide>(wide(g), slope_x, slope_y));
}

double ndf(const Gaussian &g, const Vec &wm) { return static_cast<double>(ndf(wide(g), wide(wm))); }
double plane(const Gaussian &g, const Vec &k) { return static_cast<double>(plane(wide(g), wide(k))); }
double sigma(const Gaussian &g, const Vec &k) { return static_cast<double>(sigma(wide(g), wide(k))); }

double g1(const Gaussian &g, const Vec &k) {
    const double p = plane(g, k);
    return p > 0.0 ? p / sigma(g, k) : 0.0;
}

double g2(Masking masking, double plane_i, double sigma_i, double plane_o, double sigma_o) {
    if (plane_i <= 0.0 || plane_o <= 0.0) return 0.0;
    switch (masking) {
        case Masking::separable:
            return g2_separable(plane_i, sigma_i, plane_o, sigma_o);
        case Masking::coinciding:
            return std::min(plane_i / sigma_i, plane_o / sigma_o);
        case Masking::correlated:
            break;
    }
    return g2_correlated(plane_i, sigma_i, plane_o, sigma_o);
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
