// What `slopemix tradeoff` says on the terminal: the Pareto set, and each filter beside the reference that is as good.
#include <iostream>

#include "text.h"
#include "tradeoff_analysis.h"

namespace slopemix::cli {

namespace {

std::string milliseconds(double seconds) { return general(1e3 * seconds, 3); }

std::string error_text(const Measurement &measured, const GroundTruth &truth) {
    return (is_at_floor(measured, truth) ? "< " : "") + general(error_bound(measured, truth), 3);
}

std::string bias_text(const Bias &bias) { return bias.value ? general(*bias.value, 3) : "< " + general(bias.floor, 3); }

bool is_any(const TradeoffPoint &) { return true; }

// How many times as much the cheapest point of half the error costs.
std::string half_text(const TradeoffResult &result, const TradeoffPoint &point) {
    const TradeoffPoint *half = cheapest_within(result, error_bound(point.measured, result.truth) / 2.0, is_any);
    if (!half) return "-";
    return general(half->measured.kernel_seconds.median / point.measured.kernel_seconds.median, 3) + " x";
}

void print_pareto(const TradeoffResult &result) {
    std::vector<TextRow> rows = {{"cheapest for its error", "relRMSE", "noise", "bias", "PSNR dB", "device ms",
                                  "call ms", "bytes", "half the error"}};
    for (const TradeoffPoint *point : pareto_set(result)) {
        const Measurement &measured = point->measured;
        const bool is_told = !is_at_floor(measured, result.truth);
        rows.push_back({name_of(point->configuration), error_text(measured, result.truth),
                        is_filtered(point->configuration.method) ? "-" : general(measured.noise, 3),
                        bias_text(bias_of(measured, result.truth)),
                        is_told ? fixed(psnr(measured, result.truth), 1) : "-",
                        milliseconds(measured.kernel_seconds.median), milliseconds(measured.seconds.median),
                        std::to_string(measured.bytes), half_text(result, *point)});
    }
    print_table(std::cout, rows);
}

TextRow duel_row(const TradeoffPoint &filter, const char *against, const Duel &duel) {
    return {name_of(filter.configuration), against, general(duel.error, 3),
            duel.reference ? name_of(duel.reference->configuration) : "none that was measured",
            duel.reference ? general(duel.ratio(), 3) + " x" : "-"};
}

void print_duels(const TradeoffResult &result) {
    const std::vector<const TradeoffPoint *> filters = chosen_filters(result);
    if (filters.empty()) return;
    std::vector<TextRow> rows = {{"filter", "against", "relRMSE", "reference as good", "costs"}};
    for (const TradeoffPoint *filter : filters) {
        rows.push_back(duel_row(*filter, "measured table", duel(result, *filter)));
        rows.push_back(duel_row(*filter, "fitted base", widening_duel(result, *filter)));
    }
    std::cout << '\n';
    print_table(std::cout, rows);
}

} // namespace

void print_tradeoff(const TradeoffJob &job, const TradeoffResult &result) {
    const Resolution resolution = job.flags.resolution;
    std::cout << result.material.name << ": alpha " << general(job.alpha.first, 4) << ','
              << general(job.alpha.second, 4) << ", light " << general(job.light_degrees, 4) << " degrees, "
              << resolution.width << " x " << resolution.height << " pixels, " << result.points.size() << " points\n\n";
    print_pareto(result);
    print_duels(result);

    double fit_seconds = 0.0;
    for (const TradeoffFit &fit : result.fits) fit_seconds += fit.seconds;
    std::cout << '\n';
    print_facts(std::cout,
                {{"truth", "2 x " + std::to_string(result.truth.samples) + " samples per pixel, standard error " +
                               general(result.truth.error, 2)},
                 {"its two halves", "differ by " + general(result.truth.agreement, 2) + " of what their errors say"},
                 {"errors are told", "above " + general(floor_of(result.truth), 2)},
                 {"fits", std::to_string(result.fits.size()) + ", " + fixed(fit_seconds, 1) + " seconds"},
                 {"total seconds", fixed(result.total_seconds, 1)},
                 {"written", job.file("tradeoff.svg").string()}});
}

} // namespace slopemix::cli
