// Built-in analytic materials, sampled into the form of a measured table, so that everything runs with no data file.
#pragma once

#include <string>
#include <string_view>

#include "brdf.h"

namespace smx {

constexpr std::string_view builtin_prefix = "builtin:";

// "builtin:two-layer": a rough coloured body under a sharp white gloss; "builtin:conductor": one rough metal lobe;
// "builtin:mirror": reflects all light, as sharply as the table holds.
// Throws InvalidArgument for another name.
Brdf make_builtin(const std::string &name);

} // namespace smx
