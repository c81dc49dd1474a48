// Small helpers for buffers and for the time of launches, shared by every launch function.
#pragma once

#include <vector>

#include "context.h"

namespace smx {

// A buffer with these bytes, read-only, or an empty one where `from` is null. Throws OutOfMemory, with the size, where
// the device refuses it.
cl::Buffer make_buffer(const Context &context, std::size_t bytes, const void *from = nullptr);

// The caller's own memory as a buffer, without a copy where the device has the host's memory. It must outlive the
// buffer.
cl::Buffer shared_buffer(const Context &context, std::size_t bytes, void *memory, bool is_written);

template <typename T>
cl::Buffer buffer_from(const Context &context, const std::vector<T> &values) {
    return make_buffer(context, values.size() * sizeof(T), values.data());
}

template <typename T>
cl::Buffer empty_buffer(const Context &context, std::size_t count) {
    return make_buffer(context, count * sizeof(T));
}

// A number that kernels count up, 0 at first.
cl::Buffer make_counter(Context &context);

constexpr std::size_t round_up(std::size_t count, std::size_t multiple) {
    return (count + multiple - 1) / multiple * multiple;
}

// Seconds on the device of finished launches, where the queue measures them (a caller's own may not).
class KernelTime {
  public:
    void add(const cl::Event &event);
    double seconds() const { return seconds_; }

  private:
    double seconds_ = 0.0;
};

// Enqueues a kernel on at least columns x rows work-items, in work-groups of work_group x 1 (0: of a size of ours),
// after the events of `wait`, where there are any; work-items past the last column must do nothing.
cl::Event enqueue(const Context &device, const cl::Kernel &kernel, std::size_t columns, std::size_t rows,
                  std::uint32_t work_group, const std::vector<cl::Event> *wait = nullptr);

// The same, and waits for it. Returns the seconds that it took.
double launch(Context &device, const cl::Kernel &kernel, std::size_t columns, std::size_t rows,
              std::uint32_t work_group);

} // namespace smx
