// Where the per-lobe model meets the table: directions grouped by theta_d, with weights chosen for rendered appearance.
#pragma once

#include <vector>

#include "brdf.h"

namespace smx {

// One direction pair, in what an isotropic lobe needs, with the table's value there.
struct DirectionSample {
    double tan2, inv_cos4; // of theta_h
    double ci, co, sin_i, sin_o;
    Rgb f;
    double weight; // of the residual model - f
};

struct DirectionLevel {
    double theta_d;
    double norm; // root of the sum of squares of weight * f
    std::vector<DirectionSample> samples;
};

// Levels at the given angles theta_d, whole degrees; in each, theta_h at the table's nodes and half-way
// between two (where the table, linear in sqrt(theta_h), is their mean), phi_d at nodes that shift from one theta_h to
// the next. Only measured cells above the horizon; outliers are left out.
//
// Weights: a sphere under one light shows one theta_d, and its relative error is the integral of (model - f)^2 ci^2 co
// over the solid angle of wh, over that of f^2 ci^2 co. The squared weights are that integral's, so that within a level
// peak and body count in the share in which they are seen; each level is scaled to 1 and then to how often its theta_d
// is seen under lights from everywhere.
std::vector<DirectionLevel> direction_levels(const Brdf &brdf, const std::vector<double> &theta_d);

} // namespace smx
