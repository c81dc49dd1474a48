#include "fit_report.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "brdf_metrics.h"
#include "fit_row.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char *density_note = "a slope density has no BRDF to fit other curves to: F = 1";

Json metrics_json(const std::optional<FitMetrics> &metrics) {
    if (!metrics) return {};
    Json figures;
    put_metrics(figures, metrics);
    return figures;
}

Json to_json(const Fitted &fitted) {
    const smx_fit_report &report = fitted.report;
    const bool per_lobe = fitted.model == SMX_MODEL_PER_LOBE;
    Json lobes = Json::array();
    for (const smx_lobe &lobe : fitted.lobes) lobes.push_back({{"weight", lobe.weight}, {"alpha", lobe.alpha}});
    return {{"input", fitted.input},
            {"name", fitted.name},
            {"file", fitted.file},
            {"up_to_date", fitted.up_to_date},
            {"model", word_for(fitted.model, models)},
            {"model_note", is_density(fitted.input) ? Json(density_note) : Json()},
            {"lobes", lobes},
            {"log_likelihood_em", report.log_likelihood_em},
            {"log_likelihood", report.log_likelihood},
            {"residual_em", report.residual_em},
            {"residual", report.residual},
            {"iterations",
             {{"inversion", report.inversion_iterations},
              {"em", report.em_iterations},
              {"refine", report.refine_iterations},
              {"curves", report.curve_iterations}}},
            {"brdf_residual_start", per_lobe ? Json(report.brdf_residual_start) : Json()},
            {"brdf_residual", per_lobe ? Json(report.brdf_residual) : Json()},
            {"displaced_share", per_lobe ? Json(report.displaced_share) : Json()},
            {"base_relrmse", of_table(fitted, report.base_relrmse)},
            {"displaced_relrmse", of_table(fitted, report.displaced_relrmse)},
            {"displaced_relrmse_shared", of_table(fitted, report.displaced_relrmse_shared)},
            {"choice", report.choice},
            {"refine_message", report.refine_message},
            {"curve_message", report.curve_message},
            {"seconds", report.seconds},
            {"check_seconds", report.check_seconds},
            {"metrics", metrics_json(fitted.metrics)}};
}

void print_json(const FitJob &job, const std::vector<FitOutcome> &outcomes, std::optional<double> build_seconds) {
    Json materials = Json::array(), failures = Json::array();
    for (const FitOutcome &outcome : outcomes) {
        if (outcome.fitted) materials.push_back(to_json(*outcome.fitted));
        if (!outcome.error.empty())
            failures.push_back({{"input", job.inputs[outcome.index]}, {"error", outcome.error}});
    }
    const Json document = {{"version", SMX_VERSION_STRING},
                           {"build_seconds", build_seconds ? Json(*build_seconds) : Json()},
                           {"materials", materials},
                           {"failures", failures}};
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

std::string refined(double before, double after) {
    return fixed(after, 6) + " (before the refinement " + fixed(before, 6) + ")";
}

void print_metrics(const FitMetrics &metrics) {
    std::vector<TextRow> rows = {{"  errors in BRDF space"}};
    for (const char *ending : {"", "_80"})
        for (const BrdfMetric &metric : brdf_metrics) rows[0].push_back(std::string(metric.name) + ending);
    for (std::size_t k = 0; k < measured_models.size(); ++k) {
        TextRow &row = rows.emplace_back(TextRow{measured_models[k]});
        for (const BrdfMetric &metric : brdf_metrics) row.push_back(general(metrics.errors[k].*metric.all, 4));
        for (const BrdfMetric &metric : brdf_metrics) row.push_back(general(metrics.errors[k].*metric.within_80, 4));
    }
    print_table(std::cout, rows);
    for (const BrdfMetric &metric : brdf_metrics) std::cout << "  " << metric.name << ": " << metric.formula << '\n';
    std::cout << "  _80: up to 80 degrees\n  " << brdf_metrics_note << "; " << fixed(metrics.seconds, 3)
              << " seconds\n";
}

void print_facts_of(const Fitted &fitted) {
    const smx_fit_report &report = fitted.report;
    std::cout << fitted.name << " -> " << fitted.file << ", " << word_for(fitted.model, models);
    if (is_density(fitted.input)) std::cout << " (" << density_note << ')';
    std::cout << (fitted.up_to_date ? ", up to date" : "") << '\n';
    std::vector<TextRow> rows = {{"  lobe", "weight", "alpha"}};
    for (const smx_lobe &lobe : fitted.lobes)
        rows.push_back({std::to_string(rows.size()), fixed(lobe.weight, 6), general(lobe.alpha, 5)});
    print_table(std::cout, rows);
    Facts facts = {{"  log likelihood", refined(report.log_likelihood_em, report.log_likelihood)},
                   {"  residual", refined(report.residual_em, report.residual)}};
    std::string iterations = std::to_string(report.inversion_iterations) + " inversion, " +
                             std::to_string(report.em_iterations) + " EM, " + std::to_string(report.refine_iterations) +
                             " refinement";
    if (fitted.model == SMX_MODEL_PER_LOBE) {
        facts.emplace_back("  BRDF residual", refined(report.brdf_residual_start, report.brdf_residual));
        iterations += ", " + std::to_string(report.curve_iterations) + " curves";
    }
    if (!is_density(fitted.input)) {
        facts.emplace_back("  relRMSE, estimated", fixed(report.base_relrmse, 4) + " undisplaced, " +
                                                       fixed(report.displaced_relrmse, 4) + " displaced");
        if (fitted.model == SMX_MODEL_PER_LOBE)
            facts.emplace_back("  shared model", fixed(report.displaced_relrmse_shared, 4) + " displaced");
    }
    if (report.choice[0] != '\0') facts.emplace_back("  choice", report.choice);
    facts.emplace_back("  iterations", iterations);
    facts.emplace_back("  seconds", fixed(report.seconds, 3));
    print_facts(std::cout, facts);
    if (fitted.metrics) print_metrics(*fitted.metrics);
}

TextRow line_of(const Fitted &fitted) {
    const smx_fit_report &report = fitted.report;
    return {fitted.name,
            word_for(fitted.model, models),
            std::to_string(fitted.lobes.size()),
            general(fitted.lobes.front().alpha, 3),
            general(fitted.lobes.back().alpha, 3),
            fixed(report.log_likelihood, 4),
            fixed(report.residual, 4),
            fitted.model == SMX_MODEL_PER_LOBE ? fixed(report.brdf_residual, 4) : "-",
            fixed(report.seconds, 2),
            fitted.up_to_date ? "up to date" : "fitted"};
}

void print_lines(const std::vector<FitOutcome> &outcomes) {
    std::vector<TextRow> rows = {{"material", "model", "lobes", "alpha from", "to", "log likelihood", "residual",
                                  "BRDF residual", "seconds", "state"}};
    for (const FitOutcome &outcome : outcomes)
        if (outcome.fitted) rows.push_back(line_of(*outcome.fitted));
    if (rows.size() > 1) print_table(std::cout, rows);
}

} // namespace

void print_fits(const FitJob &job, const std::vector<FitOutcome> &outcomes, std::optional<double> build_seconds) {
    if (job.json)
        print_json(job, outcomes, build_seconds);
    else if (job.inputs.size() > 1)
        print_lines(outcomes);
    else if (!outcomes.empty() && outcomes.front().fitted)
        print_facts_of(*outcomes.front().fitted);
    std::cout << std::flush;
}

} // namespace slopemix::cli
