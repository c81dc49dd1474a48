// Tables made from formulas.
#pragma once

#include <functional>
#include <string>

#include "brdf.h"

namespace smx {

// f in 1/sr of a direction pair above the horizon.
using BrdfFormula = std::function<Rgb(const Cosines &)>;

// The formula at every node of a table with 180 values of phi_d; cells below the horizon are invalid. The table's
// sha256 is that of the `.binary` file it would make.
Brdf sample_table(const std::string &name, const std::string &source, const BrdfFormula &formula);

} // namespace smx
