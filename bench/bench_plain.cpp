// The plain kernel that the reference is compared with: bench/plain_reference.cl, on OpenCL's first device of the CPU,
// nanoseconds per sample from OpenCL's events. Its mean is checked against the reference first.
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "bench.h"

namespace {

constexpr int side = 128, samples = 64;
constexpr float light_phi = 0.5f, alpha = 0.25f;

std::string source() {
    std::ifstream file(SMX_BENCH_FOLDER "/plain_reference.cl");
    return {std::istreambuf_iterator<char>(file), {}};
}

cl::Device cpu() {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    std::vector<cl::Device> devices;
    platforms.at(0).getDevices(CL_DEVICE_TYPE_ALL, &devices);
    return devices.at(0);
}

// RGB and a zero per node.
std::vector<float> table_values() {
    constexpr std::size_t cells = 90 * 90 * 180;
    std::vector<double> values(3 * cells);
    check(smx_brdf_get_values(two_layer(), values.data(), values.size()));
    std::vector<float> nodes(4 * cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
        for (std::size_t c = 0; c < 3; ++c) nodes[4 * cell + c] = static_cast<float>(values[c * cells + cell]);
    return nodes;
}

// Mean of the green pixels.
double reference_mean() {
    smx_scene scene = SMX_SCENE_INIT;
    scene.light_phi = light_phi;
    scene.displacement = {alpha, alpha, 0.0, 0.0, 0.0};
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.spp = 1024;
    smx_image image = nullptr;
    check(smx_render_reference(shared_context(), two_layer(), &scene, &options, &image, nullptr));
    double sum = 0.0;
    for (int k = 0; k < side * side; ++k) sum += static_cast<double>(smx_image_pixels(image)[4 * k + 1]);
    smx_image_release(image);
    return sum / (side * side);
}

class Plain {
  public:
    Plain()
        : device_(cpu()),
          context_(device_),
          queue_(context_, device_, CL_QUEUE_PROFILING_ENABLE),
          table_values_(table_values()),
          table_(context_, table_values_.begin(), table_values_.end(), true),
          values_(context_, CL_MEM_READ_WRITE, std::size_t{side} * side * samples * sizeof(cl_float4)),
          program_(context_, source()) {
        program_.build({device_}, "-cl-std=CL1.2");
        kernel_ = cl::Kernel(program_, "plain_reference");
        kernel_.setArg(0, values_);
        kernel_.setArg(1, side);
        kernel_.setArg(2, light_phi);
        kernel_.setArg(3, alpha);
        kernel_.setArg(4, table_);
    }

    double run(cl_uint seed) {
        kernel_.setArg(5, seed);
        cl::Event event;
        queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(std::size_t{side} * side, samples),
                                    cl::NullRange, nullptr, &event);
        event.wait();
        return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                          event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
    }

    // Of the green values, and how many samples were not off the sphere or unlit.
    double mean(std::size_t &evaluations) {
        std::vector<cl_float4> values(std::size_t{side} * side * samples);
        queue_.enqueueReadBuffer(values_, CL_TRUE, 0, values.size() * sizeof(cl_float4), values.data());
        double sum = 0.0;
        evaluations = 0;
        for (const cl_float4 &v : values) {
            sum += static_cast<double>(v.s[1]);
            evaluations += v.s[3] > 0.0f;
        }
        return sum / static_cast<double>(values.size());
    }

  private:
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    std::vector<float> table_values_;
    cl::Buffer table_, values_;
    cl::Program program_;
    cl::Kernel kernel_;
};

void plain(benchmark::State &state) {
    Plain kernel;
    kernel.run(1);
    std::size_t evaluations = 0;
    const double mean = kernel.mean(evaluations), wanted = reference_mean();
    if (!(std::abs(mean - wanted) < 0.05 * wanted)) {
        state.SkipWithError("the plain kernel's image is another one");
        return;
    }
    cl_uint seed = 2;
    for (auto _ : state) state.SetIterationTime(kernel.run(seed++));
    state.counters["s/eval"] = benchmark::Counter(
        static_cast<double>(evaluations), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(plain)->Name("reference.plain")->UseManualTime();

} // namespace
