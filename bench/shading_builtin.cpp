// Launch of bench/shading_builtin.cl.
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <fstream>
#include <iterator>

#include "shading.h"

namespace {

cl::Device first_device() {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    std::vector<cl::Device> devices;
    platforms.at(0).getDevices(CL_DEVICE_TYPE_ALL, &devices);
    return devices.at(0);
}

std::string source() {
    std::ifstream file(SMX_BENCH_FOLDER "/shading_builtin.cl");
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Builtin {
    cl::Device device = first_device();
    cl::Context context{device};
    cl::CommandQueue queue{context, device, CL_QUEUE_PROFILING_ENABLE};
    cl::Program program{context, source()};

    Builtin() { program.build({device}, "-cl-std=CL1.2"); }
};

} // namespace

ShadingResult shade_builtin(const ShadingCase &what) {
    static Builtin builtin;
    ShadingResult result{0.0, std::vector<float>(4 * shading_side * shading_side)};
    std::vector<ShadingLobe> lobes = what.lobes;
    const cl::Buffer rgba(builtin.context, CL_MEM_WRITE_ONLY, result.rgba.size() * sizeof(float));
    const cl::Buffer lobe_buffer(builtin.context, lobes.begin(), lobes.end(), true);
    cl::Kernel kernel(builtin.program, "shading_builtin");
    kernel.setArg(0, rgba);
    kernel.setArg(1, cl_int{shading_side});
    kernel.setArg(2, shading_alpha_x);
    kernel.setArg(3, shading_alpha_y);
    kernel.setArg(4, lobe_buffer);
    kernel.setArg(5, static_cast<cl_int>(lobes.size()));
    kernel.setArg(6, cl_int{what.per_lobe});
    cl::Event event;
    builtin.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(shading_side, shading_side), cl::NullRange,
                                       nullptr, &event);
    builtin.queue.enqueueReadBuffer(rgba, CL_TRUE, 0, result.rgba.size() * sizeof(float), result.rgba.data());
    result.seconds = 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                                event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
    return result;
}
