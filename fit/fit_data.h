// What a table gives to its fits, made once: the samples that they are fitted to, and its albedo.
#pragma once

#include <vector>

#include "direction_samples.h"
#include "directional_albedo.h"

namespace smx {

struct FitData {
    // Throws NoSolution for a table that reflects nothing in a measured cell above the horizon.
    explicit FitData(const Brdf &brdf);

    // A mean of the table's values. The fits' own samples have values over it, so that tolerances mean the same
    // whatever the table's scale.
    double scale = 0.0;
    std::vector<DirectionLevel> base;      // the table itself
    std::vector<DirectionLevel> displaced; // the table on displaced surfaces

    std::vector<DirectionLevel> lit; // the table under the experiment's three lights (fit_check.h), in its own values

    DirectionalAlbedo albedo;
    std::vector<Rgb> albedo_bound() const; // what a fit may reflect (DirectionalAlbedo::bound), over `scale`
};

// The base's levels, whose residuals' weights have a total of 1, and with this share the displaced ones.
std::vector<DirectionLevel> joined(const std::vector<DirectionLevel> &base,
                                   const std::vector<DirectionLevel> &displaced, double share);

} // namespace smx
