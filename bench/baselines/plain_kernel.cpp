#include "plain_kernel.h"

#include <stdexcept>
#include <vector>

#include "kernel_files.h"

namespace {

// Of all platforms, one after the other.
cl::Device device_at(unsigned index) {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    std::vector<cl::Device> all;
    for (const cl::Platform &platform : platforms) {
        std::vector<cl::Device> devices;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
        } catch (const cl::Error &) {
            continue; // a platform without a device
        }
        all.insert(all.end(), devices.begin(), devices.end());
    }
    return all.at(index);
}

std::string source_of(const std::string &file) {
    for (const smx::KernelFile &embedded : smx::kernel_files())
        if (embedded.name == file) return std::string(embedded.text);
    throw std::logic_error(file + " is not embedded");
}

cl::Kernel build(const cl::Context &context, const cl::Device &device, const std::string &name) {
    cl::Program program(context, source_of(name + ".cl"));
    try {
        program.build({device}, "-cl-std=CL1.2");
    } catch (const cl::Error &) {
        throw std::runtime_error(name + ".cl: " + program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device));
    }
    return cl::Kernel(program, name.c_str());
}

} // namespace

PlainKernel::PlainKernel(unsigned device, const std::string &name)
    : device_(device_at(device)),
      context_(device_),
      queue_(context_, device_, CL_QUEUE_PROFILING_ENABLE),
      kernel_(build(context_, device_, name)) {}

double PlainKernel::run(const cl::NDRange &items) {
    cl::Event event;
    queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, items, cl::NullRange, nullptr, &event);
    event.wait();
    return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                      event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}
