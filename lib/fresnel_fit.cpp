#include "fresnel_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clamped_cosine.h"

namespace smx {

using std::numbers::pi;

namespace {

constexpr std::size_t sigma_samples = 512; // over the cosine; linear between them

// sigma(theta) = integral of <k,h>+ D(h) dh on a grid of cosines, by the trapezoid rule in u (theta = u^2 pi/2).
std::vector<double> projected_areas(const std::vector<double> &ndf) {
    std::vector<double> sigma(sigma_samples + 1, 0.0);
    const double h = 1.0 / static_cast<double>(ndf.size());
    for (std::size_t s = 0; s <= sigma_samples; ++s) {
        const double cos_k = static_cast<double>(s) / sigma_samples, sin_k = std::sqrt(1.0 - cos_k * cos_k);
        double norm = 0.0;
        for (std::size_t j = 0; j < ndf.size(); ++j) {
            const double theta = Brdf::theta_h(j), weight = std::sin(theta) * static_cast<double>(j) * h * ndf[j];
            const double cos_cos = cos_k * std::cos(theta), sin_sin = sin_k * std::sin(theta);
            sigma[s] += clamped_cosine_ring(cos_cos, sin_sin) * weight;
            norm += 2 * pi * std::cos(theta) * weight;
        }
        sigma[s] = norm > 0.0 ? sigma[s] / norm : cos_k; // a mirror's distribution has its mass at the pole alone
    }
    return sigma;
}

double interpolate(const std::vector<double> &samples, double x) {
    const double at = x * static_cast<double>(samples.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), samples.size() - 2);
    const double share = at - static_cast<double>(below);
    return samples[below] * (1.0 - share) + samples[below + 1] * share;
}

// Quotient of the two sums over the cells of one theta_d; negative where there is nothing to divide.
Rgb energy_ratio(const Brdf &brdf, const std::vector<double> &ndf, const std::vector<double> &sigma, std::size_t d) {
    Rgb measured{};
    double model = 0.0;
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) {
            const std::size_t cell = brdf.cell(h, d, p);
            const double th = Brdf::theta_h(h), td = Brdf::theta_d(d);
            const double cos_cos = std::cos(th) * std::cos(td);
            const double sin_sin = std::sin(th) * std::sin(td) * std::cos(brdf.phi_d(p));
            const double ci = cos_cos - sin_sin, co = cos_cos + sin_sin;
            if (!brdf.valid(cell) || ci <= 0.0 || co <= 0.0) continue;

            // Solid angle of a node: sin(theta) dtheta with theta = u^2 pi/2; the pole's own is its first half cell.
            const double weight = h > 0 ? std::sin(th) * static_cast<double>(h) : Brdf::theta_h(1) / 20;
            const double g2 = ci * co / (interpolate(sigma, ci) * co + interpolate(sigma, co) * ci - ci * co);
            model += weight * ndf[h] * g2 / 4;
            for (std::size_t c = 0; c < 3; ++c) measured[c] += weight * brdf.value(c, cell) * ci * co;
        }
    Rgb ratio = {-1.0, -1.0, -1.0};
    if (model > 0.0)
        for (std::size_t c = 0; c < 3; ++c) ratio[c] = measured[c] / model;
    return ratio;
}

} // namespace

FresnelCurves fit_fresnel(const Brdf &brdf, const std::vector<double> &ndf) {
    const std::vector<double> sigma = projected_areas(ndf);
    FresnelCurves curves;
    Rgb last{};
    for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) {
        const Rgb ratio = energy_ratio(brdf, ndf, sigma, d);
        if (ratio[0] >= 0.0) last = ratio;
        for (std::size_t c = 0; c < 3; ++c) curves[c].push_back(last[c]);
    }
    for (std::vector<double> &curve : curves) curve.push_back(curve.back()); // theta_d = pi/2 has no cell
    return curves;
}

} // namespace smx
