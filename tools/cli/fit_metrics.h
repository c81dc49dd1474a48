// The errors of both models and of the baselines against a table, in BRDF space: what --metrics adds to a fit.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "fit_source.h"

namespace slopemix::cli {

inline constexpr std::array measured_models = {"shared", "per_lobe", "beckmann", "ggx", "ggx_lambert"};

struct FitMetrics {
    std::array<smx_brdf_errors, measured_models.size()> errors; // of measured_models
    double seconds;                                             // of all that is not the fit itself
};

// Of the material, of the other model fitted to the same density, and of the baselines. The source has a table.
FitMetrics measure_fit(FitSource &source, const Material &material);

// The columns of fits.csv and fits.json, MODEL_METRIC, MODEL_METRIC_80 and metrics_seconds; null without metrics.
void put_metrics(nlohmann::ordered_json &row, const std::optional<FitMetrics> &metrics);

// What put_metrics wrote; none where a figure is missing.
std::optional<FitMetrics> metrics_of(const nlohmann::ordered_json &row);

} // namespace slopemix::cli
