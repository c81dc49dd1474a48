// Inputs of the commands: measured tables, built-in materials, material files; and the fit of a table.
#pragma once

#include <string>

#include "flags.h"
#include "handles.h"

namespace slopemix::cli {

bool is_builtin(const std::string &input);
bool is_material_file(const std::string &input);

// The name that outputs made from an input carry: the file's without its ending, or the built-in's.
std::string name_of(const std::string &input);

Context open_context(const std::string &device);
Brdf open_brdf(const std::string &input);
Density invert(const Brdf &brdf);
Material fit(const Density &density, const FitFlags &flags);

} // namespace slopemix::cli
