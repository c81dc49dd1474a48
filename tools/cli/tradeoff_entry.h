// The parts of a sweep's result as JSON and back, for its journal.
#pragma once

#include <nlohmann/json.hpp>

#include "tradeoff_job.h"

namespace slopemix::cli {

nlohmann::ordered_json spread_json(const Spread &spread);

// Without the image.
nlohmann::ordered_json truth_item(const GroundTruth &truth);
nlohmann::ordered_json fit_item(const TradeoffFit &fit);
nlohmann::ordered_json point_item(const TradeoffPoint &point);

// Throw a JSON or std::invalid_argument exception for an item of another form, or a point that the plan has not.
GroundTruth truth_of(const nlohmann::ordered_json &item);
TradeoffFit fit_of(const nlohmann::ordered_json &item);
TradeoffPoint point_of(const nlohmann::ordered_json &item, const std::vector<Configuration> &plan);

} // namespace slopemix::cli
