// What a judgement of effects looks like in reports.
#pragma once

#include <nlohmann/json.hpp>

#include "slopemix.h"
#include "text.h"

namespace slopemix::cli {

nlohmann::ordered_json verdict_json(const smx_effect_verdict &verdict);
nlohmann::ordered_json verdicts_json(const smx_effect_report &report);

// Lines for what is left out of an image by a material of `lobes` lobes, each with its reason; none for what is not
// supported.
void add_left_out(Facts &facts, const smx_effect_report &report, std::uint32_t lobes);

// "2 of 8 lobes dropped".
std::string dropped_text(const smx_effect_report &report, std::uint32_t lobes);

} // namespace slopemix::cli
