// A material as a flat buffer of floats, as cl/packed.clh reads it; docs/packed-material.md has its layout.
#pragma once

#include <vector>

#include "material.h"

namespace smx {

std::size_t packed_size(const Material &material); // in floats

std::vector<float> packed(const Material &material);

} // namespace smx
