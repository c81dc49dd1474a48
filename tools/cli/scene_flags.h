// The flags of a scene: the displaced surface and the light.
#pragma once

#include <CLI/CLI.hpp>
#include <utility>

#include "flags.h"

namespace slopemix::cli {

struct SceneFlags {
    std::pair<double, double> alpha, mean_slope;
    double rho = 0.0;
    double light_degrees = 0.0;
    bool uniform_light = false; // in its place

    smx_displacement displacement() const {
        return {alpha.first, alpha.second, rho, mean_slope.first, mean_slope.second};
    }
};

void add_surface_flags(CLI::App &command, SceneFlags &flags);
void add_light_flag(CLI::App &command, SceneFlags &flags, bool takes_uniform);

} // namespace slopemix::cli
