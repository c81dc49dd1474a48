#include "context.h"

#include <algorithm>
#include <chrono>

#include "error.h"

namespace smx {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::uint32_t chosen_width(std::uint32_t wanted, std::uint32_t native) {
    require(wanted == 0 || wanted == 1 || wanted == 4 || wanted == 8 || wanted == 16, "vector_width is ", wanted,
            "; it must be 0 (the device's own), 1, 4, 8 or 16");
    return wanted ? wanted : native;
}

} // namespace

Context::Context(const cl::Device &device, std::uint32_t vector_width)
    : device_(device),
      context_(device_),
      queue_(context_, device_, CL_QUEUE_PROFILING_ENABLE),
      info_(device_info(device_)) {
    info_.vector_width = chosen_width(vector_width, info_.vector_width);
}

Context::Context(const std::vector<cl::Device> &devices, std::uint32_t vector_width)
    : Context(devices.front(), vector_width) {
    for (std::size_t k = 1; k < devices.size(); ++k) {
        others_.emplace_back(new Context(devices[k], width()));
        info_.compute_units += others_.back()->info_.compute_units;
    }
    info_.devices = static_cast<std::uint32_t>(devices.size());
}

Context::Context(const std::string &wanted, std::uint32_t vector_width, std::uint32_t sub_devices)
    : Context(choose_devices(wanted, sub_devices), vector_width) {}

Context::Context(const cl::Context &context, const cl::CommandQueue &queue, std::uint32_t vector_width)
    : device_(queue.getInfo<CL_QUEUE_DEVICE>()), context_(context), queue_(queue), info_(device_info(device_)) {
    require(queue.getInfo<CL_QUEUE_CONTEXT>()() == context(), "cl_queue belongs to another context than cl_context");
    const bool in_order = !(queue.getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
    require(in_order, "cl_queue executes out of order; slopemix needs one that executes in order");
    info_.vector_width = chosen_width(vector_width, info_.vector_width);
}

Context::Lock::Lock(Context &context) : context_(context) {
    require(context.owner_ != std::this_thread::get_id(),
            "context is in use by the call that this callback belongs to");
    lock_ = std::unique_lock(context.mutex_);
    context.owner_ = std::this_thread::get_id();
}

std::vector<Context *> Context::devices() {
    std::vector<Context *> all = {this};
    for (const auto &other : others_) all.push_back(other.get());
    return all;
}

double Context::build_seconds() const {
    double longest = build_seconds_;
    for (const auto &other : others_) longest = std::max(longest, other->build_seconds());
    return longest;
}

cl::Program Context::build(const std::string &file, const std::string &options) {
    const std::string source = kernel_source(file);
    const std::string key =
        text(options, '\n', info_.platform_version, '\n', info_.name, '\n', info_.driver, '\n', source);
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;

    const auto start = Clock::now();
    cl::Program program(context_, source);
    try {
        program.build({device_}, options.c_str());
    } catch (const cl::Error &e) {
        const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_);
        fail(Fault::KernelBuild, file, " does not build on ", info_.name, " (", opencl_error_name(e.err()),
             ") with options ", options, ":\n", log,
             info_.platform == "Portable Computing Language"
                 ? "(PoCL says no more than that where it cannot write its cache, POCL_CACHE_DIR or ~/.cache/pocl)"
                 : "");
    }
    build_seconds_ += seconds_since(start);
    return programs_.emplace(key, program).first->second;
}

cl::Kernel Context::kernel(const std::string &file, const std::string &name, const Defines &defines) {
    Defines all = defines;
    all["W"] = static_cast<int>(width());
    return cl::Kernel(build(file, build_options(all)), name.c_str());
}

bool Context::is_first_launch(const cl::Kernel &kernel, std::size_t work_group) {
    return launched_
        .emplace(kernel.getInfo<CL_KERNEL_PROGRAM>()(), kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), work_group)
        .second;
}

} // namespace smx
