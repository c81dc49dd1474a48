#include "device_buffer.h"

#include <algorithm>
#include <chrono>

#include "error.h"

namespace smx {

namespace {

// One size for all launches: PoCL compiles a kernel anew for every size of work-group.
constexpr std::size_t default_work_group = 16;

cl::Buffer new_buffer(const Context &context, cl_mem_flags flags, std::size_t bytes, void *host) {
    try {
        return cl::Buffer(context.cl(), flags, bytes, host);
    } catch (const cl::Error &e) {
        if (!is_out_of_memory(e)) throw;
        fail(Fault::OutOfMemory, context.info().name, " refuses a buffer of ", bytes, " bytes (",
             opencl_error_name(e.err()), ")");
    }
}

} // namespace

cl::Buffer make_buffer(const Context &context, std::size_t bytes, const void *from) {
    // The wrapper takes host memory as not const; CL_MEM_COPY_HOST_PTR only reads it.
    return from ? new_buffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes, const_cast<void *>(from))
                : new_buffer(context, CL_MEM_READ_WRITE, bytes, nullptr);
}

cl::Buffer shared_buffer(const Context &context, std::size_t bytes, void *memory, bool is_written) {
    return new_buffer(context, (is_written ? CL_MEM_READ_WRITE : CL_MEM_READ_ONLY) | CL_MEM_USE_HOST_PTR, bytes,
                      memory);
}

cl::Buffer make_counter(Context &context) {
    cl::Buffer counter = empty_buffer<cl_int>(context, 1);
    context.queue().enqueueFillBuffer(counter, cl_int{0}, 0, sizeof(cl_int));
    return counter;
}

void KernelTime::add(const cl::Event &event) {
    event.wait();
    try {
        const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        seconds_ += static_cast<double>(end - start) * 1e-9;
    } catch (const cl::Error &e) {
        if (e.err() != CL_PROFILING_INFO_NOT_AVAILABLE) throw;
    }
}

cl::Event enqueue(const Context &device, const cl::Kernel &kernel, std::size_t columns, std::size_t rows,
                  std::uint32_t work_group, const std::vector<cl::Event> *wait) {
    const std::size_t group = work_group ? work_group : default_work_group;
    cl::Event event;
    device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(round_up(columns, group), rows),
                                        cl::NDRange(group, 1), wait, &event);
    return event;
}

double launch(Context &device, const cl::Kernel &kernel, std::size_t columns, std::size_t rows,
              std::uint32_t work_group) {
    const std::size_t group = work_group ? work_group : default_work_group;
    const bool first = device.is_first_launch(kernel, group);
    const auto start = std::chrono::steady_clock::now();
    KernelTime time;
    time.add(enqueue(device, kernel, columns, rows, work_group));
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (first && time.seconds() > 0.0) device.add_build_seconds(std::max(elapsed - time.seconds(), 0.0));
    return time.seconds();
}

} // namespace smx
