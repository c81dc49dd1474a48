// A material and a scene without what is not simulated, and what images of them say of themselves.
#pragma once

#include <vector>

#include "choose_effects.h"
#include "material.h"
#include "render.h"

namespace smx {

// A material and a scene without what is not simulated.
struct Simplified {
    Material material;
    Scene scene;
    Effects on;
};

Simplified simplified(const Material &material, const Scene &scene, const Simulated &simulated);

// Orders of all lobes, from those of the lobes that are kept.
std::vector<int> with_dropped(const std::vector<int> &orders, const std::vector<bool> &kept);

Attributes describe_filtered(const Material &material, const Scene &scene, const RenderOptions &options,
                             const Simulated &simulated, const std::vector<int> &orders);

} // namespace smx
