// The sweep: the truth first, as exact as its points will need, then point by point.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "progress.h"
#include "run_statistics.h"
#include "text.h"
#include "tradeoff_journal.h"
#include "tradeoff_plot.h"
#include "tradeoff_render.h"

namespace slopemix::cli {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr std::uint32_t fewest_runs = 5, most_runs = 25;
constexpr std::uint64_t enough_evaluations = 1u << 22; // of a point's runs, past the fewest: tens of milliseconds
constexpr std::uint32_t truth_fewest = 1u << 16, truth_most = 1u << 20, base_truth_samples = 1u << 14;
constexpr double truth_share = 0.1; // of the smallest error that is measured

// In samples of the statistical reference, so that the progress moves evenly.
double work_of(const Configuration &configuration) {
    constexpr double path = 50.0, filter = 64.0;
    if (is_filtered(configuration.method)) return filter;
    return configuration.samples * (configuration.method == Method::geometric ? path : 1.0);
}

// The first guess of it.
std::uint32_t truth_samples(const SweepAxes &axes) { return std::clamp(4 * axes.samples, truth_fewest, truth_most); }

double total_work(const SweepAxes &axes, const std::vector<Configuration> &plan) {
    double total = 2.0 * truth_samples(axes);
    for (const Configuration &configuration : plan) total += work_of(configuration);
    return total;
}

double quantile(const std::vector<double> &sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

Spread spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

// Depends on no time, so that the errors do not. The geometric reference makes its surfaces anew for every run.
std::uint32_t run_count(Method method, std::uint64_t evaluations) {
    if (method == Method::geometric) return fewest_runs;
    const std::uint64_t count = enough_evaluations / std::max<std::uint64_t>(evaluations, 1);
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(count, fewest_runs, most_runs));
}

// The runs of one configuration.
struct Runs {
    std::vector<double> seconds, kernel_seconds, squared_errors, max_errors;
    RunStatistics statistics;
};

class Sweep {
  public:
    Sweep(const TradeoffJob &job, const std::vector<Configuration> &plan, TradeoffJournal &journal)
        : job_(job), plan_(plan), journal_(journal), progress_(total_work(job.axes, plan)), renderer_(job, progress_) {
        result_.device = info_of(renderer_.context()).name;
        result_.material = info_of(renderer_.brdf());
        journal_.open(plan_, result_);
        for (const TradeoffPoint &point : result_.points) {
            kept_.insert(name_of(point.configuration));
            progress_.advance(name_of(point.configuration), work_of(point.configuration));
        }
    }

    TradeoffResult measure() {
        if (journal_.is_complete()) return std::move(result_);
        settle_truth();
        for (const Configuration &configuration : plan_) {
            if (kept_.contains(name_of(configuration))) continue;
            result_.points.push_back({configuration, measure_point(configuration)});
            note_times();
            journal_.keep_point(result_);
        }
        for (const TradeoffPoint &point : strip_of(result_))
            result_.strip.emplace_back(point, renderer_.render(point.configuration, 1).image);
        note_times();
        return std::move(result_);
    }

  private:
    // The smallest standard error that a point will have; 0 where none has an estimate.
    double finest_error() {
        const auto has_estimate = [](const Configuration &point) {
            return point.is_as_is() && (point.method == Method::sobol || point.method == Method::mis);
        };
        std::uint32_t most = 0;
        for (const Configuration &point : plan_)
            if (has_estimate(point)) most = std::max(most, point.samples);
        double finest = 0.0;
        for (const Configuration &point : plan_) {
            if (!has_estimate(point) || point.samples != most) continue;
            const double error = renderer_.render(point, 0).report.standard_error;
            if (error > 0.0) finest = finest > 0.0 ? std::min(finest, error) : error;
        }
        return finest;
    }

    void settle_truth() {
        if (result_.truth.image) return;
        progress_.start("ground truth", 2.0 * truth_samples(job_.axes));
        std::uint32_t samples = truth_samples(job_.axes);
        result_.truth = renderer_.truth(samples);
        const double wanted = truth_share * finest_error();
        while (wanted > 0.0 && result_.truth.error > wanted && samples < truth_most)
            result_.truth = renderer_.truth(samples *= 4);
        progress_.finish();
        note_times();
        journal_.keep_truth(result_);
    }

    Measurement measure_point(const Configuration &configuration) {
        const std::string name = name_of(configuration);
        progress_.start(name, 0.0);
        const GroundTruth *base = is_filtered(configuration.method) ? &base_truth(configuration) : nullptr;
        Rendering rendering = renderer_.render(configuration, 0); // warms up
        Measurement measured;
        measured.evaluations = rendering.report.evaluations;
        measured.runs = run_count(configuration.method, measured.evaluations);
        Runs runs;
        for (std::uint32_t run = 1; run <= measured.runs; ++run) {
            progress_.start(name, work_of(configuration) / measured.runs);
            rendering = renderer_.render(configuration, run);
            note_run(rendering, runs);
            progress_.finish();
        }
        measured.bytes = renderer_.bytes(configuration);
        summarise(runs, measured);
        if (base) measured.widening = compare(rendering.image, base->image).relrmse;
        return measured;
    }

    void note_run(const Rendering &rendering, Runs &runs) const {
        const smx_comparison errors = compare(rendering.image, result_.truth.image);
        runs.seconds.push_back(rendering.report.seconds);
        runs.kernel_seconds.push_back(rendering.report.kernel_seconds);
        runs.squared_errors.push_back(errors.relrmse * errors.relrmse);
        runs.max_errors.push_back(errors.max_error);
        runs.statistics.add(rendering.image);
    }

    void summarise(const Runs &runs, Measurement &measured) const {
        measured.seconds = spread(runs.seconds);
        measured.kernel_seconds = spread(runs.kernel_seconds);
        double sum = 0.0;
        for (const double square : runs.squared_errors) sum += square;
        measured.relrmse = std::sqrt(sum / measured.runs);
        measured.mean_relrmse = compare(runs.statistics.mean(), result_.truth.image).relrmse;
        measured.noise = runs.statistics.deviation() / result_.truth.rms;
        measured.max_error = spread(runs.max_errors).median;
    }

    const GroundTruth &base_truth(const Configuration &filter) {
        const std::pair key(filter.method, filter.lobes);
        if (const auto found = base_truths_.find(key); found != base_truths_.end()) return found->second;
        const GroundTruth &truth = base_truths_[key] = renderer_.base_truth(filter, base_truth_samples);
        const auto is_known = [&](const TradeoffFit &fit) { return std::pair(fit.method, fit.lobes) == key; };
        if (std::any_of(result_.fits.begin(), result_.fits.end(), is_known)) return truth;
        const TradeoffRenderer::Fit &fit = renderer_.fit(filter);
        result_.fits.push_back({filter.method, filter.lobes, info_of(fit.material).lobes, fit.seconds,
                                compare(truth.image, result_.truth.image).relrmse, truth.error, truth.agreement});
        return truth;
    }

    void note_times() {
        result_.total_seconds = result_.earlier_seconds + Seconds(std::chrono::steady_clock::now() - begin_).count();
        result_.build_seconds = result_.earlier_build_seconds + info_of(renderer_.context()).build_seconds;
    }

    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    const TradeoffJob &job_;
    const std::vector<Configuration> &plan_;
    TradeoffJournal &journal_;
    Progress progress_;
    TradeoffRenderer renderer_;
    std::map<std::pair<Method, std::uint32_t>, GroundTruth> base_truths_;
    std::set<std::string> kept_;
    TradeoffResult result_;
};

} // namespace

TradeoffResult measure_tradeoff(const TradeoffJob &job, const std::vector<Configuration> &plan,
                                TradeoffJournal &journal) {
    return Sweep(job, plan, journal).measure();
}

} // namespace slopemix::cli
