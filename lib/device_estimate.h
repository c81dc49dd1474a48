// An Estimate of cl/estimate.clh.
#pragma once

#include "opencl.h"

namespace smx {

struct DeviceEstimate {
    cl_float4 sum, rest, mean, deviations;
};

} // namespace smx
