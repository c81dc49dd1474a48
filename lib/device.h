// The OpenCL devices of this machine, counted over all platforms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "opencl.h"

namespace smx {

struct DeviceInfo {
    std::uint32_t index = 0; // of a sub-device, its device's
    std::string name, vendor, version, driver, platform, platform_version;
    std::uint32_t compute_units = 0;
    std::uint64_t global_memory = 0;
    std::uint32_t vector_width = 1;   // evaluations per work-item
    bool has_double = false;          // cl_khr_fp64
    bool shares_memory = false;       // with the host
    std::uint64_t largest_buffer = 0; // bytes
    std::uint32_t devices = 1;        // that work together in a context
};

std::vector<cl::Device> all_devices();

DeviceInfo device_info(const cl::Device &device);

// "": the first CPU, else the first device; digits: an index; else part of a name, any case. Throws NoDevice with the
// list of those there are.
cl::Device choose_device(const std::string &wanted);

// The devices of a comma-separated list, each cut into `sub_devices` like sub-devices where that is more than 1. Throws
// NoDevice, or InvalidArgument for more sub-devices than it has compute units.
std::vector<cl::Device> choose_devices(const std::string &wanted, std::uint32_t sub_devices);

} // namespace smx
