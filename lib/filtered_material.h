// A material as the kernels of filtered shading take it, and what its images say of themselves.
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

// Widened lobes, as cl/mixture.clh reads them; all curves, as cl/fresnel.clh does; their knots over pi/2.
cl::Buffer lobe_buffer(const Context &context, const Material &material, const Displacement &x, Grade grade);
std::vector<float> packed_curves(const Material &material);
std::vector<float> packed_knots(const Material &material);

// Orders of all lobes, from those of the lobes that are kept.
std::vector<int> with_dropped(const std::vector<int> &orders, const std::vector<bool> &kept);

Attributes describe_filtered(const Material &material, const Scene &scene, const RenderOptions &options,
                             const Simulated &simulated, const std::vector<int> &orders);

} // namespace smx
