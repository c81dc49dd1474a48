// f in the plane of incidence, of a table and of the fits to it.
#pragma once

#include <vector>

#include "handles.h"

namespace slopemix::cli {

// One theta_i of 45 degrees, and theta_o from -90 to 90, positive on the mirror's side; close together about the mirror
// direction, as the table's nodes are. Rows: theta_o in degrees; f in 1/sr of the table (r, g, b) and of each material.
std::vector<std::vector<double>> slice_at_45_degrees(const Context &context, const Brdf &brdf,
                                                     const std::vector<const Material *> &materials);

} // namespace slopemix::cli
