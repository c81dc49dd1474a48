// Where the per-lobe model meets the table: directions grouped by theta_d, with weights chosen for rendered appearance.
#pragma once

#include <vector>

#include "brdf.h"

namespace smx {

// One direction pair on a surface, in what an isotropic lobe needs, with the value that a model should have there.
struct DirectionSample {
    double tan2, inv_cos4; // of theta_h
    double ci, co, sin_i, sin_o;
    Rgb f;
    double weight;              // of the residual model - f
    double displacement2 = 0.0; // squared alpha of the displaced surface that f is seen on; lobes are widened by it
};

struct DirectionLevel {
    double theta_d;
    double norm; // root of the sum of squares of weight * f
    std::vector<DirectionSample> samples;
};

// A sample at these angles, without a value or a weight. ci and co may be negative: below the horizon.
DirectionSample direction_at(double theta_h, double theta_d, double phi_d);

// Nearer the horizon than this cosine a table's cells do not resolve what they hold.
constexpr double min_cosine = 0.02;

// Rows of the table nearest to these angles.
std::vector<std::size_t> table_rows(const std::vector<double> &theta_d);

// Levels at the given angles theta_d, whole degrees; in each, theta_h at the table's nodes and, near the pole,
// half-way between two (where the table, linear in sqrt(theta_h), is their mean), phi_d at nodes that shift from one
// theta_h to the next. Only measured cells above the horizon. Weights: weigh_levels, of a total of 1.
std::vector<DirectionLevel> direction_levels(const Brdf &brdf, const std::vector<double> &theta_d);

// From the roots of quadrature weights to weights of residuals. A sphere under one light shows one theta_d, and its
// relative error is the integral of (model - f)^2 ci^2 co over the solid angle of the normal about wh, over that of f^2
// ci^2 co. So within a level peak and body count in the share in which they are seen, and each level is scaled to a sum
// of squares of 1 and then to how much of it is seen under lights from everywhere. `share` is the sum over all levels.
// Levels that reflect nothing have no relative error and are dropped.
void weigh_levels(std::vector<DirectionLevel> &levels, double share);

} // namespace smx
