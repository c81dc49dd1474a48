// Models as tables: what the reference integrates in a measured table's place, to tell the errors of a material's parts
// apart.
#pragma once

#include "brdf.h"
#include "material.h"
#include "slope_density.h"

namespace smx {

// f of the material, not displaced, at every node of a table with 180 values of phi_d, in double; cells below the
// horizon are invalid. Named after the material; its source is "memory". Throws BadFormat for an f above 1e30.
Brdf tabulate(const Material &material);

// F(theta_d) D G2 / (4 cos_i cos_o) of the density itself, with its distribution of normals on the table's own theta_h
// nodes and height-correlated Smith masking from the projected area of that distribution (projected_area.h).
Brdf tabulate(const SlopeDensity &density);

} // namespace smx
