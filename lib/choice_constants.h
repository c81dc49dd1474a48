// What lib/choose_configuration.h takes for granted; docs/choosing.md says how it is used.
// tools/calibrate-choice measures how errors fall; times are those of slopemix bench.
#pragma once

#include <array>

namespace smx::choice {

// Nanoseconds on the device where slopemix bench gave the figures of README.md.
constexpr double pixel_ns = 1.3, lobe_ns = 0.58; // closed form: of a pixel, and of each lobe in it

// An order of widening, and what a lobe takes by it, of surfaces that are rough along one axis and along two.
struct OrderCost {
    int order;
    double line_ns, plane_ns;
};
constexpr std::array<OrderCost, 6> orders = {
    {{0, lobe_ns, lobe_ns}, {1, 4.0, 4.6}, {2, 4.5, 10.0}, {3, 5.5, 13.0}, {5, 7.5, 30.0}, {8, 10.0, 68.0}}};

// By sampler (grid, sobol, mis): a sample of a pixel, and a facet that all pixels share.
constexpr std::array<double, 3> sample_ns = {1.9, 2.0, 3.3};
constexpr std::array<double, 3> facet_ns = {40.0, 60.0, 550.0};

// The reference's error falls as the samples' number to the minus `fall`, as a rule; and hardly ever faster than to the
// minus `steepest`, so that numbers too small for an error need not be tried.
constexpr std::array<double, 3> fall = {0.5, 0.6, 0.7};
constexpr double steepest = 1.25, steepest_on_a_line = 2.0;

} // namespace smx::choice
