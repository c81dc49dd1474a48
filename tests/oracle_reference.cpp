#include "oracle_reference.h"

#include <algorithm>

namespace oracle {
namespace {

void accumulate(Rgb &sum, double weight, const Rgb &value) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * value[c];
}

// G2_X / po, the factor of L that does not depend on the facet.
double outer_factor(Masking masking, const Gaussian &x, const Vec &wi, const Vec &wo) {
    if (wi.z <= 0.0 || wo.z <= 0.0 || plane(x, wi) <= 0.0 || plane(x, wo) <= 0.0) return 0.0;
    return g2(masking, x, wi, wo) / plane(x, wo);
}

// One integral over the plane of slopes, split smoothly into a part around the half vector's slope, where a sharp lobe
// of f sits, and a part around X's mean. Each part has polar coordinates of its own.
struct PlaneIntegral {
    const FacetBrdf &f;
    const Gaussian &x;
    const Vec &wi, &wo;
    double peak_x, peak_y;                // slope of the half vector
    static constexpr double reach = 0.05; // of the part around the peak

    double near_peak(double sx, double sy) const {
        const double r2 = (sx - peak_x) * (sx - peak_x) + (sy - peak_y) * (sy - peak_y);
        const double q = reach * reach + r2;
        const double around_peak = reach * reach / (pi * q * q), around_mean = p22(x, sx, sy);
        const double a = around_peak * around_peak, b = around_mean * around_mean;
        return a / (a + b);
    }

    void add(Rgb &sum, double weight, double share, double sx, double sy) const {
        const double w = weight * share * p22(x, sx, sy);
        if (w > 0.0) accumulate(sum, w, facet_integrand(f, wi, wo, sx, sy));
    }

    // Radii r = r0 (e^u - 1): fine at the peak, out to where X has no mass left.
    void add_peak_part(Rgb &sum, int n) const {
        const double r0 = 1e-4;
        const double far = std::hypot(peak_x - x.mean_x, peak_y - x.mean_y) + 7.0 * std::sqrt(x.cov_xx + x.cov_yy);
        const double du = std::log1p(far / r0) / n, dphi = 2.0 * pi / n;
        for (int j = 0; j < n; ++j) {
            const double u = (j + 0.5) * du, r = r0 * std::expm1(u), dr = r0 * std::exp(u) * du;
            for (int k = 0; k < n; ++k) {
                const double phi = (k + 0.5) * dphi;
                const double sx = peak_x + r * std::cos(phi), sy = peak_y + r * std::sin(phi);
                add(sum, r * dr * dphi, near_peak(sx, sy), sx, sy);
            }
        }
    }

    // Slopes mean + L z with L the Cholesky factor of the covariance, z polar out to 8.5 standard deviations.
    void add_mean_part(Rgb &sum, int n) const {
        const double l11 = std::sqrt(x.cov_xx), l21 = x.cov_xy / l11;
        const double l22 = std::sqrt(x.cov_yy - l21 * l21);
        const double dr = 8.5 / n, dphi = 2.0 * pi / n;
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const double r = (j + 0.5) * dr, phi = (k + 0.5) * dphi;
                const double zx = r * std::cos(phi), zy = r * std::sin(phi);
                const double sx = x.mean_x + l11 * zx, sy = x.mean_y + l21 * zx + l22 * zy;
                add(sum, r * dr * dphi * l11 * l22, 1.0 - near_peak(sx, sy), sx, sy);
            }
    }

    Rgb operator()(int n) const {
        Rgb sum{};
        add_peak_part(sum, n);
        add_mean_part(sum, n);
        return sum;
    }
};

// One alpha is 0: midpoints along the line of slopes.
Rgb line_integral(const FacetBrdf &f, const Gaussian &x, const Vec &wi, const Vec &wo, int n) {
    const bool along_x = x.cov_xx > 0.0;
    const double deviation = std::sqrt(along_x ? x.cov_xx : x.cov_yy);
    const double dz = 17.0 / n;
    Rgb sum{};
    for (int k = 0; k < n; ++k) {
        const double z = -8.5 + (k + 0.5) * dz, offset = deviation * z;
        const double weight = std::exp(-z * z / 2.0) / std::sqrt(2.0 * pi) * dz;
        accumulate(
            sum, weight,
            facet_integrand(f, wi, wo, x.mean_x + (along_x ? offset : 0.0), x.mean_y + (along_x ? 0.0 : offset)));
    }
    return sum;
}

// Evaluates a rule at n and 2n nodes.
template <class Rule>
Integral converged(double factor, int n, const Rule &rule) {
    const Rgb coarse = rule(n), fine = rule(2 * n);
    Integral result;
    for (std::size_t c = 0; c < 3; ++c) {
        result.rgb[c] = factor * fine[c];
        if (fine[c] > 0.0) result.error = std::max(result.error, std::abs(coarse[c] / fine[c] - 1.0));
    }
    return result;
}

} // namespace

FacetBrdf table_brdf(const Table &table, Lookup how) {
    return [&table, how](const Vec &wi, const Vec &wo, const Vec &wm) {
        return lookup(table, how, half_diff(wi, wo, wm));
    };
}

Rgb facet_integrand(const FacetBrdf &f, const Vec &wi, const Vec &wo, double slope_x, double slope_y) {
    const Vec wm = normalised({-slope_x, -slope_y, 1.0});
    const double im = dot(wi, wm), om = dot(wo, wm);
    if (im <= 0.0 || om <= 0.0) return {};
    Rgb sum{};
    accumulate(sum, im * om / wm.z, f(wi, wo, wm));
    return sum;
}

Integral reference(const FacetBrdf &f, Masking masking, const Gaussian &x, const Vec &wi, const Vec &wo) {
    const double factor = outer_factor(masking, x, wi, wo);
    if (factor == 0.0) return {};
    if (x.cov_xx > 0.0 && x.cov_yy > 0.0) {
        const Vec h = half_vector(wi, wo);
        const PlaneIntegral plane_integral{f, x, wi, wo, -h.x / h.z, -h.y / h.z};
        return converged(factor, 200, plane_integral);
    }
    if (x.cov_xx > 0.0 || x.cov_yy > 0.0)
        return converged(factor, 40000, [&](int n) { return line_integral(f, x, wi, wo, n); });
    return converged(factor, 1, [&](int) { return facet_integrand(f, wi, wo, x.mean_x, x.mean_y); });
}

Rgb reference_by_grid(const FacetBrdf &f, Masking masking, const Gaussian &x, const Vec &wi, const Vec &wo, int n) {
    const double factor = outer_factor(masking, x, wi, wo);
    const double range_x = 7.0 * std::sqrt(x.cov_xx), range_y = 7.0 * std::sqrt(x.cov_yy);
    const double dx = 2.0 * range_x / n, dy = 2.0 * range_y / n;
    Rgb sum{};
    for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
            const double sx = x.mean_x - range_x + (j + 0.5) * dx, sy = x.mean_y - range_y + (k + 0.5) * dy;
            accumulate(sum, factor * p22(x, sx, sy) * dx * dy, facet_integrand(f, wi, wo, sx, sy));
        }
    return sum;
}

} // namespace oracle
