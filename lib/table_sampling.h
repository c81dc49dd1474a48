// Tables made from formulas.
#pragma once

#include <functional>
#include <string>

#include "brdf.h"

namespace smx {

// f in 1/sr of a direction pair above the horizon, the same whichever direction is wi; the other form is also told the
// nodes theta_h and theta_d that the pair is at.
using BrdfFormula = std::function<Rgb(const Cosines &)>;
using TableFormula = std::function<Rgb(std::size_t theta_h, std::size_t theta_d, const Cosines &)>;

// The formula at every node of a table with 180 values of phi_d; cells below the horizon are invalid. It is called for
// a quarter of a turn: the rest are the same pairs with their directions exchanged. The table's sha256 is that of the
// `.binary` file it would make.
Brdf sample_table(const std::string &name, const std::string &source, const BrdfFormula &formula);
Brdf sample_table(const std::string &name, const std::string &source, const TableFormula &formula);

} // namespace smx
