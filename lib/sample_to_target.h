// As many samples as a standard error asks for: what the references share.
#pragma once

#include <cstdint>
#include <functional>

#include "render.h"

namespace smx {

// One try with a number of samples: what it drew, seconds on the device, and the estimate's error, negative where there
// is none.
struct Attempt {
    std::uint32_t samples;
    double kernel_seconds, standard_error;
};

// Tries until options.target_error is reached, or once without one. `lit` pairs or pixels are evaluated at every
// sample. The report's times are those of the kernels.
RenderReport sample_to_target(const RenderOptions &options, std::uint64_t lit,
                              const std::function<Attempt(std::uint32_t spp)> &attempt);

} // namespace smx
