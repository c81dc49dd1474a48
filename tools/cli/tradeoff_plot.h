// tradeoff.svg: error against time, and the same sphere at rising cost with its error beneath.
#pragma once

#include <string>

#include "tradeoff_job.h"

namespace slopemix::cli {

// Points of the Pareto set that the strip of images shows, from cheap to dear; at most this many.
inline constexpr std::size_t strip_length = 6;
std::vector<TradeoffPoint> strip_of(const TradeoffResult &result);

// Throws CommandError if gnuplot cannot be run.
std::string plot_tradeoff(const TradeoffJob &job, const TradeoffResult &result);

// The strip alone, as a part of gnuplot's script for a page of this size in pixels.
inline constexpr int page_width = 1500, page_height = 1230;
std::string tradeoff_strip(const TradeoffResult &result);

} // namespace slopemix::cli
