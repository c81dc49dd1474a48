// The picture of a fit: its slope density, its Fresnel curves, and a slice of the BRDF.
#pragma once

#include <string>

#include "fit_source.h"

namespace slopemix::cli {

// An SVG of three parts: the table's slope density with the material's lobes and their sum; the Fresnel curves of each
// channel; f in the plane of incidence at theta_i = 45 degrees, of the table and of a shared and a per-lobe fit, one of
// which is the material and the other the source's other model.
std::string plot_fit(const Context &context, FitSource &source, const Material &material);

// The first of the parts alone, for a density that is from no BRDF.
std::string plot_density(const Density &density, const Material &material);

} // namespace slopemix::cli
