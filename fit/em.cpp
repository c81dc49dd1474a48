#include "em.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "em_starts.h"
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

// One step of expectation and maximisation.
void em_step(std::vector<Lobe> &lobes, const SlopeDensity &density) {
    std::vector<double> mass(lobes.size(), 0.0), moment(lobes.size(), 0.0);
    for (std::size_t j = 0; j < density.mass.size(); ++j) {
        if (density.mass[j] <= 0.0) continue;
        const double s = density.slope[j] * density.slope[j];
        const std::vector<double> logs = log_lobes(lobes, s);
        const double total = log_sum_exp(logs);
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
}

constexpr unsigned screening_iterations = 50; // of each start, before the best goes on
constexpr std::uint64_t cluster_seeds[] = {1, 2};

std::vector<std::vector<Lobe>> starts(const SlopeDensity &density, unsigned lobes) {
    std::vector<std::vector<Lobe>> all = {quantile_start(density, lobes)};
    for (std::uint64_t seed : cluster_seeds) all.push_back(cluster_start(density, lobes, seed));
    std::erase_if(all, [](const std::vector<Lobe> &start) { return start.empty(); });
    return all;
}

// Steps until one gains less than the tolerance, or there were max_iterations in all.
void go_on(EmResult &run, const SlopeDensity &density, double tolerance, unsigned max_iterations) {
    double before = mean_log_likelihood(run.lobes, density);
    for (bool gains = true; gains && run.iterations < max_iterations; ++run.iterations) {
        em_step(run.lobes, density);
        run.log_likelihood = mean_log_likelihood(run.lobes, density);
        run.largest_fall = std::max(run.largest_fall, before - run.log_likelihood);
        gains = run.log_likelihood - before >= tolerance;
        before = run.log_likelihood;
    }
    run.log_likelihood = before;
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

EmResult climb(std::vector<Lobe> start, const SlopeDensity &density, double tolerance, unsigned max_iterations) {
    EmResult run{std::move(start), 0, 0.0, 0.0};
    canonicalise(run.lobes);
    go_on(run, density, tolerance, max_iterations);
    canonicalise(run.lobes);
    return run;
}

EmResult fit_em(const SlopeDensity &density, unsigned lobes, double tolerance, unsigned max_iterations) {
    EmResult best;
    for (std::vector<Lobe> &start : starts(density, lobes)) {
        EmResult run = climb(std::move(start), density, tolerance, std::min(screening_iterations, max_iterations));
        if (best.lobes.empty() || run.log_likelihood > best.log_likelihood) best = std::move(run);
    }
    if (best.lobes.empty()) fail(Fault::NoSolution, "the slope density has no mass");
    go_on(best, density, tolerance, max_iterations);
    canonicalise(best.lobes);
    return best;
}

} // namespace smx
