#include "material.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "error.h"

namespace smx {

namespace {

constexpr double max_weight = 1e100; // 64 of them have a sum

void validate_knots(const std::vector<double> &theta_d) {
    require(theta_d.size() >= 2 && theta_d.size() <= 4096, "Fresnel curves have 2..4096 knots, not ", theta_d.size());
    constexpr double end = std::numbers::pi / 2, rounding = 1e-12;
    require(theta_d.front() == 0.0, "theta_d[0] is ", theta_d.front(), "; it must be 0");
    require(std::abs(theta_d.back() - end) <= rounding, "the last theta_d is ", theta_d.back(), "; it must be pi/2");
    for (std::size_t k = 1; k < theta_d.size(); ++k)
        require(theta_d[k] > theta_d[k - 1], "theta_d[", k, "] is ", theta_d[k],
                "; it must be above the one before it, ", theta_d[k - 1]);
}

void validate_curve(const std::vector<double> &curve, std::size_t set, std::size_t channel, std::size_t knots) {
    require(curve.size() == knots, "fresnel[", set, "][", channel, "] has ", curve.size(), " knots, theta_d has ",
            knots);
    for (std::size_t k = 0; k < knots; ++k)
        require(curve[k] >= 0.0 && curve[k] <= max_fresnel, "fresnel[", set, "][", channel, "][", k, "] is ", curve[k],
                "; it must be 0..", max_fresnel);
}

} // namespace

void validate(const Material &m) {
    require(!m.lobes.empty() && m.lobes.size() <= max_lobes, "a material has 1..", max_lobes, " lobes, not ",
            m.lobes.size());
    for (std::size_t k = 0; k < m.lobes.size(); ++k) {
        const auto [weight, alpha] = m.lobes[k];
        require(weight >= 0.0 && weight <= max_weight && (weight > 0.0 || m.model == Model::PerLobe), "lobes[", k,
                "].weight is ", weight, "; it must be above 0");
        require(alpha >= min_alpha && alpha <= max_alpha, "lobes[", k, "].alpha is ", alpha, "; it must be ", min_alpha,
                "..", max_alpha);
    }
    validate_knots(m.theta_d);
    const std::size_t sets = m.model == Model::Shared ? 1 : m.lobes.size();
    require(m.fresnel.size() == sets, "the ", model_name(m.model), " model needs ", sets,
            " sets of Fresnel curves, not ", m.fresnel.size());
    for (std::size_t set = 0; set < sets; ++set)
        for (std::size_t c = 0; c < 3; ++c) validate_curve(m.fresnel[set][c], set, c, m.theta_d.size());
}

std::string model_name(Model model) { return model == Model::Shared ? "shared" : "per-lobe"; }

std::vector<double> uniform_knots(std::size_t knots) {
    std::vector<double> theta_d;
    for (std::size_t k = 0; k < knots; ++k)
        theta_d.push_back(std::numbers::pi / 2 * static_cast<double>(k) / static_cast<double>(knots - 1));
    return theta_d;
}

std::vector<double> energy_shares(const std::vector<double> &theta_d, const std::vector<FresnelCurves> &fresnel) {
    std::vector<double> shares;
    double total = 0.0;
    for (const FresnelCurves &curves : fresnel) {
        double energy = 0.0;
        for (const std::vector<double> &curve : curves)
            for (std::size_t j = 0; j + 1 < theta_d.size(); ++j) {
                const double middle = (theta_d[j] + theta_d[j + 1]) / 2, width = theta_d[j + 1] - theta_d[j];
                energy += width * std::sin(2 * middle) * (curve[j] + curve[j + 1]) / 2;
            }
        shares.push_back(energy);
        total += energy;
    }
    for (double &share : shares) share = total > 0.0 ? share / total : 1.0 / static_cast<double>(shares.size());
    return shares;
}

void canonicalise(std::vector<Lobe> &lobes) {
    double total = 0.0;
    for (const Lobe &lobe : lobes) total += lobe.weight;
    for (Lobe &lobe : lobes) lobe.weight /= total;
    std::stable_sort(lobes.begin(), lobes.end(), [](const Lobe &a, const Lobe &b) { return a.alpha < b.alpha; });
}

void canonicalise(Material &m) {
    if (m.model == Model::PerLobe) {
        std::vector<std::size_t> order(m.lobes.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return m.lobes[a].alpha < m.lobes[b].alpha; });
        std::vector<FresnelCurves> sorted;
        for (std::size_t k : order) sorted.push_back(std::move(m.fresnel[k]));
        m.fresnel = std::move(sorted);
    }
    canonicalise(m.lobes);
}

Rgb fresnel_at(const std::vector<double> &knots, const FresnelCurves &curves, double theta_d) {
    const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, theta_d);
    const auto above = static_cast<std::size_t>(next - knots.begin()), below = above - 1;
    const double share = std::clamp((theta_d - knots[below]) / (knots[above] - knots[below]), 0.0, 1.0);
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c) f[c] = std::lerp(curves[c][below], curves[c][above], share);
    return f;
}

} // namespace smx
