// The flags of what is simulated.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "flags.h"

namespace slopemix::cli {

void add_effect_flags(CLI::App &command, RenderFlags &flags);
void add_effect_tolerance(CLI::App &command, RenderFlags &flags);

// --g is another spelling of height-correlation. Throws CLI::ValidationError where both are given and one says yes, the
// other no.
void require_consistent_effects(const CLI::App &command, const RenderFlags &flags);

// "auto", "all", "none", or the names.
std::string effects_text(std::uint32_t effects);
std::vector<std::string> effect_names(std::uint32_t effects);

} // namespace slopemix::cli
