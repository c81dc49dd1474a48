// Launches of cl/shade_filtered.cl: a material's mixture widened by X in closed form.
#pragma once

#include "material.h"
#include "render.h"

namespace smx {

Rendered shade_filtered(Context &context, const Material &material, const Scene &scene, const RenderOptions &options);

// f cos for `count` pairs of directions; wi, wo, fcos are [count][3], packed.
void shade_filtered_pairs(Context &context, const Material &material, const Displacement &displacement, Masking masking,
                          std::size_t count, const float *wi, const float *wo, float *fcos);

} // namespace smx
