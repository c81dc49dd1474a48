// A fit's report as a member of a material file (docs/material-format.md).
#pragma once

#include <nlohmann/json.hpp>

#include "json_reader.h"
#include "material.h"

namespace smx {

nlohmann::ordered_json report_to_json(const FitReport &report);
FitReport report_from_json(JsonReader in);

// Curves of three channels as {"r": [...], "g": [...], "b": [...]}.
constexpr const char *channel_names[] = {"r", "g", "b"};

std::vector<double> numbers_from_json(const JsonReader &in);

} // namespace smx
