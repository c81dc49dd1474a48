// The Fresnel curve of each channel, given the distribution of normals on the table's theta_h nodes.
#pragma once

#include <vector>

#include "brdf.h"
#include "projected_area.h"
#include "slope_density.h"

namespace smx {

// The projected area of a distribution of normals on the table's theta_h nodes.
ProjectedArea projected_area(const std::vector<double> &ndf);

// F(theta_d) = sum of f cos_i cos_o / sum of D G2 / 4 over the measured cells of that theta_d, weighted by solid angle:
// the curve under which table and model reflect the same energy onto facets of every tilt. G2 is height-correlated
// Smith of `ndf`. Knots at theta_d = k pi/180, k = 0..90; where nothing was measured the curve goes on level.
FresnelCurves fit_fresnel(const Brdf &brdf, const std::vector<double> &ndf);

} // namespace smx
