// OpenCL's C++ wrapper, with this project's settings (lib/CMakeLists.txt), as a system header.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

#include <string>

namespace smx {

// Name of an OpenCL error code, like CL_OUT_OF_RESOURCES.
std::string opencl_error_name(cl_int code);

// The code is one of those that say that memory is short.
bool is_out_of_memory(const cl::Error &error);

// Turns an exception of the wrapper into ours: OutOfMemory for the codes that mean it, else DeviceError.
[[noreturn]] void fail_opencl(const cl::Error &error);

} // namespace smx
