// One Beckmann lobe with height-correlated Smith masking, f without its Fresnel factor, and its derivative by log
// alpha. Host side, in double, for the fits; the device's form is in cl/mixture.clh.
#pragma once

#include "direction_samples.h"

namespace smx {

struct LobeValue {
    double value;      // D G2 / (4 ci co)
    double derivative; // by log alpha
};

// The lobe is widened by the sample's displacement, as the closed form widens it; alpha is its own.
LobeValue lobe_value(const DirectionSample &s, double alpha);

} // namespace smx
