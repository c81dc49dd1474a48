#include "fit_metrics.h"

#include <chrono>
#include <cmath>
#include <string>

#include "brdf_metrics.h"
#include "interrupt.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char *seconds_column = "metrics_seconds";

smx_brdf_errors errors_of(const Material &material, const Brdf &brdf) {
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    check(smx_material_brdf_errors(material.get(), brdf.get(), &errors));
    return errors;
}

smx_brdf_errors errors_of(smx_baseline kind, const Brdf &brdf) {
    stop_if_interrupted();
    smx_baseline_report report = SMX_BASELINE_REPORT_INIT;
    check(smx_baseline_fit(brdf.get(), kind, &report));
    return report.errors;
}

// Calls visit(column, figure) for each figure of the metrics.
void for_each_figure(auto &metrics, auto visit) {
    for (std::size_t k = 0; k < measured_models.size(); ++k)
        for (const bool within_80 : {false, true})
            for (const BrdfMetric &metric : brdf_metrics)
                visit(std::string(measured_models[k]) + '_' + metric.name + (within_80 ? "_80" : ""),
                      metrics.errors[k].*(within_80 ? metric.within_80 : metric.all));
    visit(seconds_column, metrics.seconds);
}

} // namespace

FitMetrics measure_fit(FitSource &source, const Material &material) {
    const auto start = std::chrono::steady_clock::now();
    const bool is_shared = info_of(material).model == SMX_MODEL_SHARED;
    const Material &other = source.other_model();
    FitMetrics metrics = {
        {errors_of(is_shared ? material : other, source.brdf()), errors_of(is_shared ? other : material, source.brdf()),
         errors_of(SMX_BASELINE_BECKMANN, source.brdf()), errors_of(SMX_BASELINE_GGX, source.brdf()),
         errors_of(SMX_BASELINE_GGX_LAMBERT, source.brdf())},
        0.0};
    metrics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return metrics;
}

void put_metrics(Json &row, const std::optional<FitMetrics> &metrics) {
    constexpr FitMetrics none = {};
    for_each_figure(metrics ? *metrics : none, [&](const std::string &column, double figure) {
        row[column] = metrics && std::isfinite(figure) ? Json(figure) : Json();
    });
}

std::optional<FitMetrics> metrics_of(const Json &row) {
    FitMetrics metrics = {};
    metrics.errors.fill(SMX_BRDF_ERRORS_INIT);
    bool complete = true;
    for_each_figure(metrics, [&](const std::string &column, auto &figure) {
        complete = complete && row.contains(column) && row[column].is_number();
        if (complete) figure = row[column].template get<double>();
    });
    return complete ? std::optional(metrics) : std::nullopt;
}

} // namespace slopemix::cli
