// tradeoff.json and tradeoff.csv: docs/tradeoff.md has the schema.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "text.h"
#include "tradeoff_analysis.h"
#include "tradeoff_entry.h"
#include "widening_json.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char *format_name = "slopemix-tradeoff";
constexpr unsigned format_version = 1;

double ns_per_evaluation(const Measurement &measured) {
    return 1e9 * measured.kernel_seconds.median / static_cast<double>(measured.evaluations);
}

Json configuration_json(const Configuration &configuration) {
    const bool filtered = is_filtered(configuration.method);
    return {{"name", name_of(configuration)},
            {"method", word_for(configuration.method, methods)},
            {"samples", filtered ? Json() : Json(configuration.samples)},
            {"lobes", filtered ? Json(configuration.lobes) : Json()},
            {"widening_order", filtered ? order_json(configuration.order) : Json()},
            {"variant", configuration.is_as_is() ? Json() : Json(variants()[configuration.variant].word)}};
}

// An error that is told from the truth, or null.
Json told(double value, bool is_told) { return is_told && std::isfinite(value) ? Json(value) : Json(); }

double base_floor(const TradeoffResult &result, const Configuration &filter) {
    for (const TradeoffFit &fit : result.fits)
        if (fit.method == filter.method && fit.lobes == filter.lobes) return floor_factor * fit.standard_error;
    return 0.0;
}

Json point_json(const TradeoffPoint &point, const TradeoffResult &result, bool is_pareto) {
    const Measurement &measured = point.measured;
    const bool is_told = !is_at_floor(measured, result.truth);
    const Bias bias = bias_of(measured, result.truth);
    Json json = configuration_json(point.configuration);
    json["runs"] = measured.runs;
    json["seconds"] = spread_json(measured.seconds);
    json["kernel_seconds"] = spread_json(measured.kernel_seconds);
    json["evaluations"] = measured.evaluations;
    json["ns_per_evaluation"] = ns_per_evaluation(measured);
    json["bytes"] = measured.bytes;
    json["at_floor"] = !is_told;
    json["relrmse"] = told(measured.relrmse, is_told);
    json["psnr_db"] = told(psnr(measured, result.truth), is_told);
    json["max_error"] = told(measured.max_error, is_told);
    json["noise"] = is_filtered(point.configuration.method) ? Json() : Json(measured.noise);
    json["bias"] = bias.value ? Json(*bias.value) : Json();
    json["bias_floor"] = bias.floor;
    const bool widening_told = measured.widening && *measured.widening > base_floor(result, point.configuration);
    json["widening"] = widening_told ? Json(*measured.widening) : Json();
    json["pareto"] = is_pareto;
    return json;
}

Json points_json(const TradeoffResult &result) {
    const std::vector<const TradeoffPoint *> front = pareto_set(result);
    const std::set<const TradeoffPoint *> on_front(front.begin(), front.end());
    Json points = Json::array();
    for (const TradeoffPoint &point : result.points)
        points.push_back(point_json(point, result, on_front.contains(&point)));
    return points;
}

Json line_json(const std::optional<Line> &line) {
    return line ? Json{{"a", line->constant}, {"b", line->slope}} : Json();
}

Json calibration_json(const TradeoffResult &result) {
    Json samplers = Json::array(), filters = Json::array();
    for (const SamplerLaw &law : sampler_laws(result))
        samplers.push_back({{"method", word_for(law.method, methods)},
                            {"noise", law.noise ? Json{{"c", law.noise->factor}, {"p", law.noise->exponent}} : Json()},
                            {"seconds", line_json(law.seconds)},
                            {"kernel_seconds", line_json(law.kernel_seconds)}});
    for (const TradeoffPoint &point : result.points) {
        const Configuration &c = point.configuration;
        if (!is_filtered(c.method) || !c.is_as_is()) continue;
        const Bias bias = bias_of(point.measured, result.truth);
        filters.push_back({{"model", word_for(c.method, methods)},
                           {"lobes", c.lobes},
                           {"widening_order", order_json(c.order)},
                           {"bias", bias.value ? Json(*bias.value) : Json()},
                           {"ns_per_evaluation", ns_per_evaluation(point.measured)}});
    }
    return {{"samplers", samplers}, {"filtered", filters}};
}

Json duel_json(const Duel &duel) {
    Json json = {{"error", duel.error}};
    json["reference"] = duel.reference ? Json(name_of(duel.reference->configuration)) : Json();
    json["ratio"] = duel.reference ? Json(duel.ratio()) : Json();
    return json;
}

Json duels_json(const TradeoffResult &result) {
    Json duels = Json::array();
    for (const TradeoffPoint *filter : chosen_filters(result))
        duels.push_back({{"filter", name_of(filter->configuration)},
                         {"measured_table", duel_json(duel(result, *filter))},
                         {"fitted_base", duel_json(widening_duel(result, *filter))}});
    return duels;
}

Json fits_json(const TradeoffResult &result) {
    Json fits = Json::array();
    for (const TradeoffFit &fit : result.fits) fits.push_back(fit_item(fit));
    return fits;
}

// A field of the CSV; empty for null.
std::string field(const Json &value) {
    if (value.is_null()) return "";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

} // namespace

Json tradeoff_settings(const TradeoffJob &job, const TradeoffResult &result) {
    Json lists = {{"methods", Json::array()}, {"widening_orders", Json::array()}};
    for (const Method method : job.axes.methods) lists["methods"].push_back(word_for(method, methods));
    for (const std::int32_t order : job.axes.orders) lists["widening_orders"].push_back(order_json(order));
    Json settings = {{"version", smx_version()}, {"input", job.input}, {"material", result.material.name}};
    settings["sha256"] = result.material.sha256;
    settings["device"] = result.device;
    settings["alpha"] = {job.alpha.first, job.alpha.second};
    settings["light_phi_deg"] = job.light_degrees;
    settings["resolution"] = {job.flags.resolution.width, job.flags.resolution.height};
    settings["seed"] = job.flags.seed;
    settings["methods"] = lists["methods"];
    settings["samples"] = job.axes.samples;
    settings["lobes"] = job.axes.lobes;
    settings["widening_orders"] = lists["widening_orders"];
    return settings;
}

std::string tradeoff_json(const TradeoffJob &job, const TradeoffResult &result) {
    Json document = {{"format", format_name}, {"format_version", format_version}};
    document.update(tradeoff_settings(job, result));
    document["total_seconds"] = result.total_seconds;
    document["build_seconds"] = result.build_seconds;
    document["kept_points"] = result.kept_points;
    document["truth"] = truth_item(result.truth);
    document["truth"]["floor"] = floor_of(result.truth);
    document["fits"] = fits_json(result);
    document["points"] = points_json(result);
    document["filter_against_reference"] = duels_json(result);
    document["calibration"] = calibration_json(result);
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

// The points of the JSON, a row each; a time's spread in columns of its own.
std::string tradeoff_csv(const TradeoffResult &result) {
    std::string text;
    for (const Json &point : points_json(result)) {
        std::string head, line;
        const auto add = [&](const std::string &name, const Json &value) {
            head += (head.empty() ? "" : ",") + name;
            line += (line.empty() ? "" : ",") + field(value);
        };
        for (const auto &[name, value] : point.items()) {
            if (!value.is_object()) add(name, value);
            if (!value.is_object()) continue;
            for (const auto &[part, number] : value.items()) add(part + '_' + name, number);
        }
        if (text.empty()) text = head + '\n';
        text += line + '\n';
    }
    return text;
}

} // namespace slopemix::cli
