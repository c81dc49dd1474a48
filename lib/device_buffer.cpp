#include "device_buffer.h"

namespace smx {

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

} // namespace smx
