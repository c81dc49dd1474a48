// Materials by formula and parameter, sampled into the form of a measured table: known answers, and anything else that
// a few numbers describe.
#pragma once

#include <string>
#include <string_view>

#include "brdf.h"

namespace smx {

constexpr std::string_view analytic_prefix = "analytic:";

// From what follows the prefix:
//   beckmann,alpha=A,f0=F          A 1e-3..10, F 0..1
//   ggx,alpha=A,f0=F               (below 1e-3 the table's first cells are wider than the lobe)
//   blinn-phong,exponent=E,f0=F    E 0..1e6
//   lambert,albedo=F               f = F / pi
// F is one number, or three joined by slashes. The first three are f = (F + (1 - F)(1 - cos theta_d)^5) D G2 / (4 cos_i
// cos_o) with Schlick's Fresnel curve and height-correlated Smith masking from the projected area of their own D: exact
// for Beckmann and GGX; for Blinn-Phong, D = (E + 2) / (2 pi) cos^E, integrated numerically (projected_area.h).
// The name is the specification with underscores for slashes. Throws InvalidArgument.
Brdf make_analytic(const std::string &specification);

} // namespace smx
