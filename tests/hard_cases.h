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
};

// Case number `index` of an endless, fixed list; every ordered pair of the alphas, and every set of lobes, comes early.
HardCase hard_case(std::size_t index);

// Both directions as a pair of floats each.
struct HardPair {
    std::array<float, 3> wi, wo;
};

// Pairs for a case: half of them about its lobes' peaks and tails, half of them on the edges of the hemisphere.
std::vector<HardPair> hard_pairs(const HardCase &c, std::size_t count, uint64_t seed);

// Fresnel curves over theta_d / (pi/2), [channel] of a set; red Schlick-like, green 0, blue steep, down to 1e-10.
inline constexpr std::size_t hard_knots = 5;
inline constexpr std::array<float, hard_knots> hard_theta_d{0.0f, 0.3f, 0.301f, 0.9f, 1.0f};
std::array<float, hard_knots> hard_curve(std::size_t set, std::size_t channel);

} // namespace test
