// What a lobe counts: in the model's sum, of the microsurface, and of the directions that are drawn.
#pragma once

#include <vector>

#include "material.h"

namespace smx {

enum class LobeWeight {
    Model,   // factor of its density in the model's sum: of the per-lobe model 1, where the curves say how much it is
    Surface, // share of the microsurface: smx_lobe's weight
    Drawn    // share of the directions that are drawn from it
};

// One per lobe; of the microsurface and of what is drawn they sum to 1.
std::vector<double> lobe_weights(const Material &material, LobeWeight which);

// Bound of f cos / density of the directions drawn so: the largest F, of the per-lobe model the largest F_k / share_k;
// over knots and channels. (With height-correlated or separable masking: G2 is at most either G1.)
double drawn_bound(const Material &material);

} // namespace smx
