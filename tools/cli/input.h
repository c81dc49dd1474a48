// Inputs of the commands: measured tables, built-in and analytic materials, slope densities, material files; and the
// fit of a table or a density.
#pragma once

#include <string>

#include "flags.h"
#include "handles.h"

namespace slopemix::cli {

bool is_synthetic(const std::string &input); // builtin:NAME or analytic:KIND,...
bool is_density(const std::string &input);   // density:FILE.csv
bool is_material_file(const std::string &input);

// The name that outputs made from an input carry: the file's without its ending, or what follows "builtin:" or
// "analytic:", with underscores for slashes.
std::string name_of(const std::string &input);

// How a synthetic input is written, for --help.
inline constexpr const char *synthetic_help =
    "builtin:two-layer, builtin:conductor, analytic:beckmann,alpha=A,f0=F, analytic:ggx,alpha=A,f0=F,\n"
    "analytic:blinn-phong,exponent=E,f0=F or analytic:lambert,albedo=F; F is one number or r/g/b";

Context open_context(const RenderFlags &flags);
Brdf open_brdf(const std::string &input);
Density invert(const Brdf &brdf);
Material fit(const Density &density, const FitFlags &flags);

// A table's inversion, or the density that the input is.
Density open_density(const std::string &input);

// The flags for this input: a density has no BRDF, and takes the shared model unless --model asks for the other one,
// which is wrong usage (CLI::ValidationError).
FitFlags fit_flags_for(const std::string &input, FitFlags flags);

} // namespace slopemix::cli
