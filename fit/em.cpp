#include "em.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.h"

namespace smx {

namespace {

// A lobe whose share falls below this holds less than a rounding of the density's mass.
constexpr double dead_weight = 1e-14;

// Two lobes become one where that costs less than this in mean log likelihood.
constexpr double merge_loss = 1e-9;

double log_lobe(const Lobe &lobe, double s) {
    const double alpha2 = lobe.alpha * lobe.alpha;
    return std::log(lobe.weight) - s / alpha2 - std::log(std::numbers::pi * alpha2);
}

std::vector<double> log_lobes(const std::vector<Lobe> &lobes, double s) {
    std::vector<double> logs;
    logs.reserve(lobes.size());
    for (const Lobe &lobe : lobes) logs.push_back(log_lobe(lobe, s));
    return logs;
}

double bounded_alpha(double mean_s) { return std::clamp(std::sqrt(mean_s), min_alpha, max_alpha); }

// Equal shares of the mass in order of slope, each lobe with its share's mean squared slope.
std::vector<Lobe> quantile_start(const SlopeDensity &density, unsigned count) {
    std::vector<double> mass(count, 0.0), moment(count, 0.0);
    double before = 0.0;
    for (std::size_t j = 0; j < density.mass.size(); ++j) {
        // A node that reaches over several shares is split among them.
        const double from = before * count, to = (before + density.mass[j]) * count;
        for (auto k = static_cast<unsigned>(from); k < count && k < to; ++k) {
            const double part = std::min(to, k + 1.0) - std::max(from, static_cast<double>(k));
            mass[k] += part;
            moment[k] += part * density.slope[j] * density.slope[j];
        }
        before += density.mass[j];
    }
    std::vector<Lobe> lobes;
    for (unsigned k = 0; k < count; ++k)
        if (mass[k] > 0.0) lobes.push_back({1.0 / count, bounded_alpha(moment[k] / mass[k])});
    return lobes;
}

// One step; returns the mean log likelihood of the lobes it started from.
double em_step(std::vector<Lobe> &lobes, const SlopeDensity &density) {
    std::vector<double> mass(lobes.size(), 0.0), moment(lobes.size(), 0.0);
    double likelihood = 0.0;
    for (std::size_t j = 0; j < density.mass.size(); ++j) {
        if (density.mass[j] <= 0.0) continue;
        const double s = density.slope[j] * density.slope[j];
        const std::vector<double> logs = log_lobes(lobes, s);
        const double total = log_sum_exp(logs);
        likelihood += density.mass[j] * total;
        for (std::size_t k = 0; k < lobes.size(); ++k) {
            const double share = density.mass[j] * std::exp(logs[k] - total);
            mass[k] += share;
            moment[k] += share * s;
        }
    }
    std::vector<Lobe> next;
    for (std::size_t k = 0; k < lobes.size(); ++k)
        if (mass[k] > dead_weight) next.push_back({mass[k], bounded_alpha(moment[k] / mass[k])});
    lobes = std::move(next);
    return likelihood;
}

// The pair k, k + 1 as one lobe of the same mass and mean squared slope.
std::vector<Lobe> joined(const std::vector<Lobe> &lobes, std::size_t k) {
    const Lobe &a = lobes[k], &b = lobes[k + 1];
    const double weight = a.weight + b.weight;
    const double moment = a.weight * a.alpha * a.alpha + b.weight * b.alpha * b.alpha;
    std::vector<Lobe> fewer = lobes;
    fewer[k] = {weight, bounded_alpha(moment / weight)};
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    return fewer;
}

} // namespace

double log_sum_exp(const std::vector<double> &logs) {
    const double top = *std::max_element(logs.begin(), logs.end());
    double sum = 0.0;
    for (double value : logs) sum += std::exp(value - top);
    return top + std::log(sum);
}

double log_p22(const std::vector<Lobe> &lobes, double s) { return log_sum_exp(log_lobes(lobes, s)); }

double mean_log_likelihood(const std::vector<Lobe> &lobes, const SlopeDensity &density) {
    double likelihood = 0.0;
    for (std::size_t j = 0; j < density.mass.size(); ++j)
        if (density.mass[j] > 0.0) likelihood += density.mass[j] * log_p22(lobes, density.slope[j] * density.slope[j]);
    return likelihood;
}

void merge_redundant(std::vector<Lobe> &lobes, const SlopeDensity &density) {
    double likelihood = mean_log_likelihood(lobes, density);
    for (std::size_t k = 0; k + 1 < lobes.size();) {
        const std::vector<Lobe> fewer = joined(lobes, k);
        const double changed = mean_log_likelihood(fewer, density);
        if (changed < likelihood - merge_loss) {
            ++k;
            continue;
        }
        lobes = fewer;
        likelihood = changed;
    }
}

EmResult fit_em(const SlopeDensity &density, unsigned lobes, double tolerance, unsigned max_iterations) {
    EmResult result;
    result.lobes = quantile_start(density, lobes);
    if (result.lobes.empty()) fail(Fault::NoSolution, "the slope density has no mass");
    double before = -std::numeric_limits<double>::infinity();
    for (bool gains = true; gains && result.iterations < max_iterations; ++result.iterations) {
        const double likelihood = em_step(result.lobes, density);
        gains = likelihood - before >= tolerance;
        before = likelihood;
    }
    canonicalise(result.lobes);
    result.log_likelihood = mean_log_likelihood(result.lobes, density);
    return result;
}

} // namespace smx
