// A device, its queue, and the kernels built for it. Kernels are built on first use and kept, by their full source and
// options; PoCL keeps their binaries on disk itself. Where several devices work together, each has a context, and the
// first one holds the others.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "device.h"
#include "opencl.h"

namespace smx {

// -D parameters of a build.
using Defines = std::map<std::string, int>;

class Context {
  public:
    // On devices of ours (device.h says what `wanted` may be), or on a context and queue of the caller's, retained.
    // vector_width 0: the first device's own; all have the same.
    Context(const std::string &wanted, std::uint32_t vector_width, std::uint32_t sub_devices = 0);
    Context(const cl::Context &context, const cl::CommandQueue &queue, std::uint32_t vector_width);

    // The kernel `name` of file `name.cl`, or of `file`, built with W and the defines. A kernel object of its own, so
    // that arguments are not shared. Throws KernelBuild with the compiler's log.
    cl::Kernel kernel(const std::string &file, const std::string &name, const Defines &defines = {});

    const DeviceInfo &info() const { return info_; }
    std::uint32_t width() const { return info_.vector_width; }

    // Whether kernels work on the host's arrays in place.
    bool shares_memory() const { return info_.shares_memory; }
    void copy_arrays() { info_.shares_memory = false; }
    const cl::Context &cl() const { return context_; }
    const cl::CommandQueue &queue() const { return queue_; }
    double build_seconds() const; // of all builds so far, on the device that built longest

    // A driver may compile a kernel as late as its first launch in a size of work-groups. launch() asks whether this is
    // the first, and counts what it took beyond its run as build.
    bool is_first_launch(const cl::Kernel &kernel, std::size_t work_group);
    void add_build_seconds(double seconds) { build_seconds_ += seconds; }

    // The devices that work together, this one first. Each is one thread's at a time.
    std::vector<Context *> devices();
    std::size_t device_count() const { return 1 + others_.size(); }

    // Calls on one context run one after another. Throws InvalidArgument where this thread is in such a call already:
    // in its progress callback.
    class Lock {
      public:
        explicit Lock(Context &context);
        ~Lock() { context_.owner_ = std::thread::id(); }
        Lock(const Lock &) = delete;
        Lock &operator=(const Lock &) = delete;

      private:
        Context &context_;
        std::unique_lock<std::mutex> lock_;
    };

  private:
    Context(const cl::Device &device, std::uint32_t vector_width);
    Context(const std::vector<cl::Device> &devices, std::uint32_t vector_width);
    cl::Program build(const std::string &file, const std::string &options);

    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    DeviceInfo info_;
    std::vector<std::unique_ptr<Context>> others_;
    std::map<std::string, cl::Program> programs_;
    std::set<std::tuple<cl_program, std::string, std::size_t>> launched_; // kernels and sizes of their work-groups
    std::atomic<double> build_seconds_ = 0.0;
    std::mutex mutex_;
    std::atomic<std::thread::id> owner_{};
};

// The text of a kernel file with its includes put in place, each once, with #line directives so that a compiler's log
// names the files.
std::string kernel_source(const std::string &file);

// -D options in a fixed order.
std::string build_options(const Defines &defines);

} // namespace smx
