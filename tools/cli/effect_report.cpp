#include "effect_report.h"

namespace slopemix::cli {

using Json = nlohmann::ordered_json;

Json verdict_json(const smx_effect_verdict &verdict) {
    return {{"effect", smx_effect_name(verdict.effect)},
            {"supported", verdict.supported != 0},
            {"on", verdict.on != 0},
            {"contribution", verdict.contribution >= 0.0 ? Json(verdict.contribution) : Json()},
            {"reason", verdict.reason}};
}

Json verdicts_json(const smx_effect_report &report) {
    Json verdicts = Json::array();
    for (const smx_effect_verdict &verdict : report.verdicts) verdicts.push_back(verdict_json(verdict));
    return verdicts;
}

std::string dropped_text(const smx_effect_report &report, std::uint32_t lobes) {
    return std::to_string(lobes - report.lobes) + " of " + std::to_string(lobes) + " lobes dropped";
}

void add_left_out(Facts &facts, const smx_effect_report &report, std::uint32_t lobes) {
    auto add = [&, label = "left out"](const std::string &text) mutable {
        facts.emplace_back(label, text);
        label = "";
    };
    for (const smx_effect_verdict &verdict : report.verdicts)
        if (verdict.supported && !verdict.on) add(std::string(smx_effect_name(verdict.effect)) + ": " + verdict.reason);
    if (report.lobes < lobes) add(dropped_text(report, lobes));
    if (report.left_out > 0.0) add("in all " + general(report.left_out, 2) + " of the image, as estimated");
}

} // namespace slopemix::cli
