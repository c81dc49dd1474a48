// Slope densities that come as samples over the angle and not from a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slope_density.h"

namespace smx {

enum class DensityKind { P22 = 0, Ndf = 1 }; // over the slope plane; over normals, ndf = p22 / cos^4(theta)

struct DensitySamples {
    DensityKind kind = DensityKind::P22;
    std::vector<double> theta, values;
};

// What is wrong with a sample that follows one at theta `before` (none: negative); nothing if it is legal: theta
// ascending in 0..pi/2 (and a millionth, for rounded files), the value 0..1e30.
std::optional<std::string> sample_fault(double theta, double value, double before);

// On the inversion's nodes: linear between the samples in theta, level below the first, 0 beyond the last; normalised,
// so that the unit of the values is free. F is 1 at every angle. Needs two samples. Throws InvalidArgument, and
// NoSolution for a density without mass on the nodes (the first two are at 0 and 1.9e-4, the last at 1.54).
SlopeDensity density_from_samples(const DensitySamples &samples);

} // namespace smx
