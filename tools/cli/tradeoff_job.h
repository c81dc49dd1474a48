// What `slopemix tradeoff` is asked for and what comes out.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flags.h"
#include "ground_truth.h"
#include "tradeoff_plan.h"

namespace slopemix::cli {

struct TradeoffJob {
    std::string input, out;
    std::pair<double, double> alpha = {0.25, 0.25};
    double light_degrees = 0.0;
    bool quick = false, resume = false, json = false;
    SweepAxes axes; // whole once the command line is read
    RenderFlags flags;

    std::filesystem::path file(const std::string &name) const { return std::filesystem::path(out) / name; }
    std::filesystem::path journal_file() const { return file("tradeoff.partial.json"); }
    std::filesystem::path truth_file() const { return file("truth.exr"); }
};

// Of the runs' times: the median, and the quartiles about it.
struct Spread {
    double median = 0.0, low = 0.0, high = 0.0;
};

// What was measured of a configuration, errors relative to the rms of the truth.
struct Measurement {
    std::uint32_t runs = 0;         // warm ones, each of another seed
    Spread seconds, kernel_seconds; // of the whole call, and from OpenCL's events
    std::uint64_t evaluations = 0;  // of one run
    std::uint64_t bytes = 0;        // of the material's representation
    double relrmse = 0.0;           // of a run, as root mean square over the runs
    double mean_relrmse = 0.0;      // of the mean of the runs
    double noise = 0.0;             // standard deviation of a run about that mean; 0 for the filter
    double max_error = 0.0;         // largest |run - truth|, median of the runs
    std::optional<double> widening; // of the filter: against the reference of the fitted base
};

struct TradeoffPoint {
    Configuration configuration;
    Measurement measured;
};

// A fitted base, and how its own reference was measured.
struct TradeoffFit {
    Method method;
    std::uint32_t lobes;   // asked for
    std::uint32_t found;   // in the material
    double seconds;        // of the fit, the inversion apart
    double relrmse;        // of the base's reference against the truth: what the fit is off without any widening
    double standard_error; // of the base's reference
    double agreement;      // of its two halves, as the truth's
};

struct TradeoffResult {
    smx_brdf_info material;
    std::string device;
    GroundTruth truth;
    std::vector<TradeoffFit> fits;
    std::vector<TradeoffPoint> points;
    std::vector<std::pair<TradeoffPoint, Image>> strip; // a few of the Pareto set, from cheap to dear, as one run each
    std::size_t kept_points = 0;                        // of an interrupted run
    double total_seconds = 0.0, earlier_seconds = 0.0;
    double build_seconds = 0.0, earlier_build_seconds = 0.0; // of these, compiling kernels
};

class TradeoffJournal;

// Measures the plan's points, without those that the journal has.
TradeoffResult measure_tradeoff(const TradeoffJob &job, const std::vector<Configuration> &plan,
                                TradeoffJournal &journal);

// What the points depend on: members of tradeoff.json, which a resumed run must have too.
nlohmann::ordered_json tradeoff_settings(const TradeoffJob &job, const TradeoffResult &result);

std::string tradeoff_json(const TradeoffJob &job, const TradeoffResult &result);
std::string tradeoff_csv(const TradeoffResult &result);
void print_tradeoff(const TradeoffJob &job, const TradeoffResult &result);

} // namespace slopemix::cli
