#include "tradeoff_analysis.h"

#include <algorithm>
#include <cmath>

namespace slopemix::cli {

namespace {

constexpr double bias_factor = 3.0;

struct Sample {
    double x, y, weight;
};

// y = a + b x by weighted least squares; nothing for less than two places.
std::optional<Line> line_through(const std::vector<Sample> &samples) {
    double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const Sample &s : samples) {
        weight += s.weight;
        x += s.weight * s.x;
        y += s.weight * s.y;
    }
    if (!(weight > 0.0)) return {};
    x /= weight;
    y /= weight;
    for (const Sample &s : samples) {
        xx += s.weight * (s.x - x) * (s.x - x);
        xy += s.weight * (s.x - x) * (s.y - y);
    }
    if (!(xx > 0.0)) return {};
    return Line{y - xy / xx * x, xy / xx};
}

std::optional<PowerLaw> noise_law(const std::vector<const TradeoffPoint *> &points, const GroundTruth &truth) {
    std::vector<Sample> samples;
    for (const TradeoffPoint *point : points)
        if (!is_at_floor(point->measured, truth) && point->measured.noise > 0.0)
            samples.push_back({std::log(point->configuration.samples), std::log(point->measured.noise), 1.0});
    const std::optional<Line> line = line_through(samples);
    if (!line) return {};
    return PowerLaw{std::exp(line->constant), -line->slope};
}

std::optional<Line> time_law(const std::vector<const TradeoffPoint *> &points, Spread Measurement::*time) {
    std::vector<Sample> samples;
    for (const TradeoffPoint *point : points) {
        const double seconds = (point->measured.*time).median;
        if (seconds > 0.0)
            samples.push_back({static_cast<double>(point->configuration.samples), seconds, 1.0 / (seconds * seconds)});
    }
    return line_through(samples);
}

} // namespace

double floor_of(const GroundTruth &truth) { return floor_factor * truth.error; }

bool is_at_floor(const Measurement &measured, const GroundTruth &truth) { return measured.relrmse <= floor_of(truth); }

double error_bound(const Measurement &measured, const GroundTruth &truth) {
    return std::max(measured.relrmse, floor_of(truth));
}

double psnr(const Measurement &measured, const GroundTruth &truth) {
    return 20.0 * std::log10(truth.peak / (measured.relrmse * truth.rms));
}

Bias bias_of(const Measurement &measured, const GroundTruth &truth) {
    const double variance = measured.noise * measured.noise / measured.runs + truth.error * truth.error;
    Bias bias{{}, bias_factor * std::sqrt(variance)};
    if (measured.mean_relrmse > bias.floor)
        bias.value = std::sqrt(measured.mean_relrmse * measured.mean_relrmse - variance);
    return bias;
}

std::vector<const TradeoffPoint *> pareto_set(const TradeoffResult &result) {
    std::vector<const TradeoffPoint *> points, front;
    for (const TradeoffPoint &point : result.points) points.push_back(&point);
    const auto cost = [](const TradeoffPoint *point) { return point->measured.kernel_seconds.median; };
    std::stable_sort(points.begin(), points.end(), [&](auto *a, auto *b) { return cost(a) < cost(b); });
    double best = HUGE_VAL;
    for (const TradeoffPoint *point : points) {
        const double error = error_bound(point->measured, result.truth);
        if (error >= best) continue;
        best = error;
        front.push_back(point);
    }
    return front;
}

const TradeoffPoint *cheapest_within(const TradeoffResult &result, double error,
                                     bool (*is_wanted)(const TradeoffPoint &)) {
    const TradeoffPoint *cheapest = nullptr;
    for (const TradeoffPoint &point : result.points) {
        if (!is_wanted(point) || error_bound(point.measured, result.truth) > error) continue;
        if (!cheapest || point.measured.kernel_seconds.median < cheapest->measured.kernel_seconds.median)
            cheapest = &point;
    }
    return cheapest;
}

std::vector<SamplerLaw> sampler_laws(const TradeoffResult &result) {
    std::vector<SamplerLaw> laws;
    for (const auto &[word, method] : methods) {
        std::vector<const TradeoffPoint *> points;
        for (const TradeoffPoint &point : result.points)
            if (point.configuration.method == method && !is_filtered(method) && point.configuration.is_as_is())
                points.push_back(&point);
        if (points.empty()) continue;
        laws.push_back({method, noise_law(points, result.truth), time_law(points, &Measurement::seconds),
                        time_law(points, &Measurement::kernel_seconds)});
    }
    return laws;
}

namespace {

bool is_plain_reference(const TradeoffPoint &point) {
    return !is_filtered(point.configuration.method) && point.configuration.is_as_is();
}

} // namespace

Duel duel(const TradeoffResult &result, const TradeoffPoint &filter) {
    const double error = error_bound(filter.measured, result.truth);
    return {&filter, cheapest_within(result, error, is_plain_reference), error};
}

Duel widening_duel(const TradeoffResult &result, const TradeoffPoint &filter) {
    const double error = filter.measured.widening.value_or(0.0);
    return {&filter, cheapest_within(result, error, is_plain_reference), error};
}

std::vector<const TradeoffPoint *> chosen_filters(const TradeoffResult &result) {
    std::vector<Configuration> plan;
    for (const TradeoffPoint &point : result.points) plan.push_back(point.configuration);
    const std::optional<Configuration> chosen = chosen_filter(plan);
    std::vector<const TradeoffPoint *> filters;
    for (const TradeoffPoint &point : result.points) {
        const Configuration &c = point.configuration;
        if (chosen && c.is_as_is() && c.method == chosen->method && c.lobes == chosen->lobes) filters.push_back(&point);
    }
    return filters;
}

} // namespace slopemix::cli
