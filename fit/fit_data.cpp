#include "fit_data.h"

#include <cmath>

#include "curve_basis.h"
#include "displaced_samples.h"
#include "error.h"
#include "fit_check.h"

namespace smx {

namespace {

constexpr double displacements[] = {0.25, 0.5}; // their closed form is where the fit's error is made

std::vector<DirectionLevel> on_displaced_surfaces(const Brdf &brdf, const std::vector<double> &theta_d) {
    std::vector<DirectionLevel> levels;
    for (double alpha : displacements) {
        const auto more = displaced_levels(brdf, theta_d, alpha, 1.0 / std::size(displacements));
        levels.insert(levels.end(), more.begin(), more.end());
    }
    return levels;
}

// On displaced surfaces curves of theta_d need fewer angles: the smoothness that they have from the base is enough.
std::vector<double> every_other(const std::vector<double> &angles) {
    std::vector<double> some;
    for (std::size_t k = 0; k < angles.size(); k += 2) some.push_back(angles[k]);
    return some;
}

// Weights are inverse to the values of their levels.
double mean_value(const std::vector<DirectionLevel> &levels) {
    double sum = 0.0;
    for (const DirectionLevel &level : levels)
        for (const DirectionSample &s : level.samples) sum += s.weight * s.weight;
    return 1.0 / std::sqrt(sum);
}

void divide_values(std::vector<DirectionLevel> &levels, double scale) {
    for (DirectionLevel &level : levels)
        for (DirectionSample &s : level.samples) {
            s.weight *= scale;
            for (double &channel : s.f) channel /= scale;
        }
}

} // namespace

FitData::FitData(const Brdf &brdf)
    : base(direction_levels(brdf, curve_levels())),
      displaced(on_displaced_surfaces(brdf, every_other(curve_levels()))),
      lit(direction_levels(brdf, light_angles())),
      albedo(brdf) {
    if (base.empty())
        fail(Fault::NoSolution, brdf.name(), ": nothing is reflected in a measured cell above the horizon");
    scale = mean_value(base);
    divide_values(base, scale);
    divide_values(displaced, scale);
}

std::vector<Rgb> FitData::albedo_bound() const {
    std::vector<Rgb> bound = albedo.bound();
    for (Rgb &at : bound)
        for (double &channel : at) channel /= scale;
    return bound;
}

std::vector<DirectionLevel> joined(const std::vector<DirectionLevel> &base,
                                   const std::vector<DirectionLevel> &displaced, double share) {
    std::vector<DirectionLevel> levels = base;
    const double factor = std::sqrt(share);
    for (DirectionLevel level : displaced) {
        level.norm *= factor;
        for (DirectionSample &s : level.samples) s.weight *= factor;
        levels.push_back(std::move(level));
    }
    return levels;
}

} // namespace smx
