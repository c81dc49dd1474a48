// One kernel of a .cl file of this folder, named like it, on one device.
#pragma once

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <string>

class PlainKernel {
  public:
    // `device` counts as smx_device_get_info does.
    PlainKernel(unsigned device, const std::string &name);

    const cl::Context &context() const { return context_; }
    const cl::CommandQueue &queue() const { return queue_; }
    cl::Kernel &kernel() { return kernel_; }

    // Waits for it; seconds from OpenCL's event.
    double run(const cl::NDRange &items);

  private:
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    cl::Kernel kernel_;
};
