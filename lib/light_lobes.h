// What cl/draw_light.clh draws directions from: a material's lobes, widened by X.
#pragma once

#include <vector>

#include "material.h"
#include "scene.h"

namespace smx {

// A LightLobe of cl/draw_light.clh.
template <typename Real>
struct DeviceLightLobe {
    Real up_to, alpha_1, alpha_2, exponent_1, exponent_2, peak;
};

// Half of the draws by the lobes' weights, half evenly: at a slant a lobe of little weight may be most of what is seen.
template <typename Real>
std::vector<DeviceLightLobe<Real>> light_lobes(const Material &material, const Displacement &x);

} // namespace smx
