// Filtered shading under a uniform light: one launch function for cl/shade_uniform.cl.
#pragma once

#include "choose_effects.h"
#include "material.h"
#include "render.h"

namespace smx {

// The sphere, as shade_filtered has it, of a scene with a uniform light: options.spp samples per pixel, or as many as
// options.target_error needs. An order that is chosen by itself needs a directional light.
Rendered shade_uniform(Context &context, const Material &material, const Scene &scene, const RenderOptions &options,
                       const Simulated &simulated);

} // namespace smx
