// A measured table cut at one theta_d, as cl/table_slice.clh reads it.
#pragma once

#include <vector>

#include "brdf.h"
#include "render.h"

namespace smx {

// RGB and a zero per node, [theta_h][phi_d columns over 0..pi, and the first one again]. A table over the full azimuth
// is folded to phi_d modulo pi by reciprocity (mean of both halves).
std::vector<float> table_slice(const Brdf &brdf, double theta_d, Lookup lookup);

// Columns over 0..pi, without the repeated one.
constexpr std::size_t slice_columns = 180;

// Mean over the azimuths that are the same modulo pi.
double folded(const Brdf &brdf, std::size_t channel, std::size_t theta_h, std::size_t theta_d, std::size_t column);

} // namespace smx
