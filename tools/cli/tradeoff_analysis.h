// What a sweep's measurements say: noise and bias apart, what is at the floor of the truth, the Pareto set, and the
// laws that go through the points.
#pragma once

#include <optional>
#include <vector>

#include "tradeoff_job.h"

namespace slopemix::cli {

// A point is at the floor where its error is not more than ten times the truth's own: it is told from the truth no
// better than that.
inline constexpr double floor_factor = 10.0;
double floor_of(const GroundTruth &truth);
bool is_at_floor(const Measurement &measured, const GroundTruth &truth);

// The error, or the floor where it is at that.
double error_bound(const Measurement &measured, const GroundTruth &truth);

// 20 log10(peak / rmse), the peak being the truth's.
double psnr(const Measurement &measured, const GroundTruth &truth);

// What the mean over the runs is off by, with the share of noise and of the truth's error taken out of it. Told only
// where that mean is off by more than `floor`, three times what these two leave in it.
struct Bias {
    std::optional<double> value;
    double floor;
};
Bias bias_of(const Measurement &measured, const GroundTruth &truth);

// Points of which none is cheaper (kernel time) with an error as small, in ascending cost.
std::vector<const TradeoffPoint *> pareto_set(const TradeoffResult &result);

// The cheapest point that is_wanted with an error of at most this; null if there is none.
const TradeoffPoint *cheapest_within(const TradeoffResult &result, double error,
                                     bool (*is_wanted)(const TradeoffPoint &));

// c n^-p
struct PowerLaw {
    double factor, exponent;
};

// a + b n
struct Line {
    double constant, slope;
};

// How a method of so many samples behaves: laws through its points as they are by default; nothing where less than two
// points say something.
struct SamplerLaw {
    Method method;
    std::optional<PowerLaw> noise;               // over the samples, in logarithms, through points above the floor
    std::optional<Line> seconds, kernel_seconds; // by least squares of the relative error
};
std::vector<SamplerLaw> sampler_laws(const TradeoffResult &result);

// A filter beside the cheapest reference whose error is no larger.
struct Duel {
    const TradeoffPoint *filter, *reference; // the latter null where no reference that was measured is as good
    double error;                            // of the filter

    // Kernel time of the reference over that of the filter.
    double ratio() const { return reference->measured.kernel_seconds.median / filter->measured.kernel_seconds.median; }
};

// Of a filter as it is by default: by its error against the measured table, and by that against its own base, in which
// only the widening counts.
Duel duel(const TradeoffResult &result, const TradeoffPoint &filter);
Duel widening_duel(const TradeoffResult &result, const TradeoffPoint &filter);

// The filters by default of the model and the number of lobes that the variants are of, by order; empty without
// filters.
std::vector<const TradeoffPoint *> chosen_filters(const TradeoffResult &result);

} // namespace slopemix::cli
