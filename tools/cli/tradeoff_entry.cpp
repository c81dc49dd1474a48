#include "tradeoff_entry.h"

#include <algorithm>

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

Spread spread_of(const Json &json) { return {json.at("median"), json.at("low"), json.at("high")}; }

} // namespace

Json spread_json(const Spread &spread) {
    return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

Json truth_item(const GroundTruth &truth) {
    return {{"samples", truth.samples},
            {"standard_error", truth.error},
            {"agreement", truth.agreement},
            {"rms", truth.rms},
            {"peak", truth.peak}};
}

GroundTruth truth_of(const Json &item) {
    GroundTruth truth;
    item.at("samples").get_to(truth.samples);
    item.at("standard_error").get_to(truth.error);
    item.at("agreement").get_to(truth.agreement);
    item.at("rms").get_to(truth.rms);
    item.at("peak").get_to(truth.peak);
    return truth;
}

Json fit_item(const TradeoffFit &fit) {
    return {{"model", word_for(fit.method, methods)},
            {"lobes", fit.lobes},
            {"lobes_found", fit.found},
            {"seconds", fit.seconds},
            {"relrmse", fit.relrmse},
            {"standard_error", fit.standard_error},
            {"agreement", fit.agreement}};
}

TradeoffFit fit_of(const Json &item) {
    return {parse_choice(item.at("model").get<std::string>(), methods),
            item.at("lobes"),
            item.at("lobes_found"),
            item.at("seconds"),
            item.at("relrmse"),
            item.at("standard_error"),
            item.at("agreement")};
}

Json point_item(const TradeoffPoint &point) {
    const Measurement &measured = point.measured;
    return {{"name", name_of(point.configuration)},
            {"runs", measured.runs},
            {"seconds", spread_json(measured.seconds)},
            {"kernel_seconds", spread_json(measured.kernel_seconds)},
            {"evaluations", measured.evaluations},
            {"bytes", measured.bytes},
            {"relrmse", measured.relrmse},
            {"mean_relrmse", measured.mean_relrmse},
            {"noise", measured.noise},
            {"max_error", measured.max_error},
            {"widening", measured.widening ? Json(*measured.widening) : Json()}};
}

TradeoffPoint point_of(const Json &item, const std::vector<Configuration> &plan) {
    const auto name = item.at("name").get<std::string>();
    const auto found = std::find_if(plan.begin(), plan.end(), [&](const auto &c) { return name_of(c) == name; });
    if (found == plan.end()) throw std::invalid_argument("there is no point " + name);
    Measurement measured;
    item.at("runs").get_to(measured.runs);
    measured.seconds = spread_of(item.at("seconds"));
    measured.kernel_seconds = spread_of(item.at("kernel_seconds"));
    item.at("evaluations").get_to(measured.evaluations);
    item.at("bytes").get_to(measured.bytes);
    item.at("relrmse").get_to(measured.relrmse);
    item.at("mean_relrmse").get_to(measured.mean_relrmse);
    item.at("noise").get_to(measured.noise);
    item.at("max_error").get_to(measured.max_error);
    if (!item.at("widening").is_null()) measured.widening = item.at("widening").get<double>();
    return {*found, measured};
}

} // namespace slopemix::cli
