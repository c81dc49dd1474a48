// A material's lobes, widened by X, as the device has them.
#pragma once

#include <vector>

#include "lobe_weights.h"
#include "material.h"
#include "scene.h"

namespace smx {

// As in cl/mixture.clh.
template <typename Real>
struct DeviceLobe {
    Real weight, alpha2, exponent_1, exponent_2, peak;
};

// Each lobe's variances plus X's, along X's principal axes, made in double. A lobe that has no width along an axis even
// so, a mirror's, gets a peak of 0: it masks, and has no density.
template <typename Real>
std::vector<DeviceLobe<Real>> widened_lobes(const Material &material, const Displacement &x,
                                            LobeWeight which = LobeWeight::Model);

} // namespace smx
