#include "fit_per_lobe.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "curve_basis.h"
#include "fit_check.h"
#include "lobe_curves.h"
#include "refine_per_lobe.h"

namespace smx {

namespace {

constexpr double first_share = 0.03;
constexpr double more_shares[] = {0.1, 0.2};
constexpr double allowed_growth = 1.05, allowed_rise = 0.006, allowed_to = 0.045;

constexpr unsigned first_iterations = 20, continued_iterations = 6;

PerLobeFit in_order_of_alpha(const PerLobeFit &fit) {
    std::vector<std::size_t> order(fit.alphas.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fit.alphas[a] < fit.alphas[b]; });
    PerLobeFit sorted;
    for (std::size_t k : order) {
        sorted.alphas.push_back(fit.alphas[k]);
        sorted.curves.push_back(fit.curves[k]);
    }
    return sorted;
}

// Writes a fit in order of alpha into the material, its curves at whole degrees.
void store(const PerLobeFit &fit, double scale, Material &m) {
    m.model = Model::PerLobe;
    m.theta_d = uniform_knots(91);
    m.fresnel.clear();
    for (const CurveCoefficients &coefficients : fit.curves) {
        m.fresnel.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            m.fresnel.back()[c] = curve_values(coefficients[c], m.theta_d);
            for (double &value : m.fresnel.back()[c]) value *= scale;
        }
    }
    const std::vector<double> shares = energy_shares(m.theta_d, m.fresnel);
    m.lobes.clear();
    for (std::size_t k = 0; k < shares.size(); ++k) m.lobes.push_back({shares[k], fit.alphas[k]});
}

double base_relrmse(const FitData &data, const PerLobeFit &fit) {
    Material material;
    store(fit, data.scale, material);
    return mean_relrmse(data.lit, material);
}

// Refines with the first share, then with larger ones while the base allows it. `base` loses the weight of its faults.
PerLobeRefinement refine(const FitData &data, const PerLobeFit &start, std::vector<DirectionLevel> &base,
                         double &share) {
    share = first_share;
    PerLobeRefinement best{start, 0, {}};
    refine_per_lobe(joined(base, data.displaced, share), first_iterations, best);
    if (reweigh(base, best.fit)) refine_per_lobe(joined(base, data.displaced, share), continued_iterations, best);

    const double alone = base_relrmse(data, best.fit);
    const double allowed = std::max(allowed_growth * alone, std::min(alone + allowed_rise, allowed_to));
    for (double more : more_shares) {
        PerLobeRefinement next = best;
        refine_per_lobe(joined(base, data.displaced, more), continued_iterations, next);
        if (base_relrmse(data, next.fit) > allowed) break;
        best = next;
        share = more;
    }
    bound_energy(joined(base, data.displaced, share), data.albedo, data.albedo_bound(), continued_iterations, best);
    return best;
}

} // namespace

FittedCurves fit_per_lobe(const FitData &data, const std::vector<double> &alphas, bool refine_too, Material &material) {
    PerLobeFit fit{alphas, fit_curves(joined(data.base, data.displaced, first_share), alphas)};
    FitReport &report = material.report;
    report.brdf_residual_start = brdf_residual(data.base, fit);
    std::vector<DirectionLevel> base = data.base;
    if (refine_too) {
        const PerLobeRefinement refined = refine(data, fit, base, report.displaced_share);
        report.curve_iterations = refined.iterations;
        report.curve_message = refined.message;
        fit = refined.fit;
    }
    report.brdf_residual = brdf_residual(data.base, fit);
    fit = in_order_of_alpha(fit);
    store(fit, data.scale, material);
    return {fit, joined(base, data.displaced, report.displaced_share)};
}

std::vector<double> spread_alphas(const std::vector<Lobe> &mixture) {
    const double low = std::log(mixture.front().alpha), high = std::log(mixture.back().alpha);
    std::vector<double> alphas;
    for (std::size_t k = 0; k < mixture.size(); ++k)
        alphas.push_back(
            std::exp(std::lerp(low, high, (static_cast<double>(k) + 0.5) / static_cast<double>(mixture.size()))));
    return alphas;
}

} // namespace smx
