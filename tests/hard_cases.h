// The grid of hard cases (docs/stability.md): surfaces, lobes and pairs of directions where shading code breaks, all of
// them floats, so that the device and the oracle are given the same numbers.
#pragma once

#include <array>
#include <vector>

#include "oracle.h"
#include "random.h"

namespace test {

struct HardSurface {
    double alpha_x = 0.0, alpha_y = 0.0, rho = 0.0, mean_x = 0.0, mean_y = 0.0;
};

struct HardCase {
    HardSurface x;
    std::vector<oracle::Lobe> lobes;
    bool is_equidistant = false; // knots of its Fresnel curves

    bool is_isotropic() const { return x.alpha_x == x.alpha_y && x.rho == 0.0; }
    bool has_mean() const { return x.mean_x != 0.0 || x.mean_y != 0.0; }
};

// Case number `index` of an endless, fixed list; every ordered pair of the alphas, and every set of lobes, comes early.
// One in eight is isotropic without a mean slope, one in eight has no mean slope.
HardCase hard_case(std::size_t index);

// Both directions as a pair of floats each.
struct HardPair {
    std::array<float, 3> wi, wo;
};

// Pairs for a case: half of them about its lobes' peaks and tails, half of them on the edges of the hemisphere.
std::vector<HardPair> hard_pairs(const HardCase &c, std::size_t count, uint64_t seed);

// Fresnel curves over theta_d / (pi/2), [channel] of a set; red Schlick-like, green 0, or 1 over equidistant knots,
// blue steep, down to 1e-10.
inline constexpr std::size_t hard_knots = 5;
using HardCurve = std::array<float, hard_knots>;
HardCurve hard_theta_d(const HardCase &c);
HardCurve hard_curve(const HardCase &c, std::size_t set, std::size_t channel);

} // namespace test
