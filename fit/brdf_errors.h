// Errors in BRDF space, in the field's own metrics (docs/metrics.md): how far a model's f is from a table's r.
#pragma once

#include "brdf.h"
#include "material.h"
#include "table_sampling.h"

namespace smx {

// Roots of weighted means of squares, over the pairs of directions and the channels:
//   l2         (f - r) cos_i                        Ngan, Durand, Matusik 2005
//   log        ln(1 + f cos_i) - ln(1 + r cos_i)    Low, Kronander, Ynnerman, Unger 2012
//   cube_root  (f cos_i)^(1/3) - (r cos_i)^(1/3)    Fores, Ferwerda, Gu 2012
struct MetricErrors {
    double l2 = 0.0, log = 0.0, cube_root = 0.0;
};

struct BrdfErrors {
    MetricErrors all;    // over every pair above the horizon
    MetricErrors within; // without those with theta_i or theta_o beyond 80 degrees
};

// At the reference's own valid cells, each weighted by the measure of the pairs (wi, wo) that it stands for,
//   dwi dwo = 4 cos(theta_d) sin(theta_d) dtheta_d sin(theta_h) dtheta_h dphi_d dphi_h,
// and counted with either direction as wi. Throws NoSolution for a reference with no valid cell within 80 degrees.
BrdfErrors brdf_errors(const TableFormula &model, const Brdf &reference);
BrdfErrors brdf_errors(const Material &material, const Brdf &reference);

// Between two tables, at the cells that are valid in both.
BrdfErrors brdf_errors(const Brdf &brdf, const Brdf &reference);

} // namespace smx
