// The nodes on which a radial slope density is held: the table's theta_h, as a quadrature over theta.
#pragma once

#include <array>
#include <vector>

#include "slope_density.h"

namespace smx {

// theta = u^2 pi/2 on equidistant u. The densities vanish smoothly at both ends in u, where the trapezoid rule
// converges fastest; node 0 gets a mass of its own (Brdf::theta_h_weight) and the root mean square slope there. A
// Beckmann alpha comes back to 0.44 % at 1e-3, to 0.05 % from 3e-3; below 1e-3 it is not in the table.
struct DensityNodes {
    static constexpr std::size_t count = Brdf::theta_h_count;
    std::array<double, count> cos{}, sin{}, weight{}, slope{};

    DensityNodes();

    // Shares of the projected area, mass[j] ~ D cos, from a distribution of normals; normalises the distribution. Empty
    // where there is nothing to share: no mass, or not a finite one.
    std::vector<double> normalise(std::vector<double> &ndf) const;

    // Writes slope, p22 and area of a normalised distribution.
    void store(const std::vector<double> &ndf, SlopeDensity &density) const;
};

} // namespace smx
