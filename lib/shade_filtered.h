// Launches of cl/shade_filtered.cl and cl/shade_widened.cl: a material's mixture widened by X, each lobe by its order.
#pragma once

#include "choose_effects.h"
#include "material.h"
#include "render.h"

namespace smx {

// `simulated` is what the options' effects have come to (choose_effects.h).
Rendered shade_filtered(Context &context, const Material &material, const Scene &scene, const RenderOptions &options,
                        const Simulated &simulated);

// Values of single lobes, without Fresnel factor, [entry][count], where entry j lobes + k is of lobe k by
// orders[entry]. Of a material and a scene that are simplified already.
struct LobeValues {
    std::vector<float> values;
    double kernel_seconds;
};
LobeValues eval_lobes(Context &context, const Material &material, const std::vector<int> &orders, const Scene &scene,
                      Effects on, Grade grade, std::size_t count, const float *wi, const float *wo);

} // namespace smx
