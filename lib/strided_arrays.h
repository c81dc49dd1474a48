// Arrays of numbers and of vectors where the caller has them: on the host, or in buffers; and the first as the second,
// in place where the device shares the host's memory (cl/strided.clh).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "context.h"

namespace smx {

// `coordinates` 1 or 3: element k of coordinate c is at[c][k * stride]. Read, or written; what is written and null is
// dropped.
struct HostArray {
    std::size_t coordinates;
    std::array<float *, 3> at;
    std::size_t stride;
    bool is_written;
};

HostArray read_vectors(const float *x, const float *y, const float *z, std::size_t stride);
HostArray written_scalars(float *values, std::size_t stride);
HostArray written_vectors(float *x, float *y, float *z, std::size_t stride);

// The same in buffers, places in floats.
struct DeviceArray {
    std::size_t coordinates;
    std::array<cl::Buffer, 3> in;
    std::array<cl_ulong, 3> offset;
    cl_ulong stride;

    DeviceArray from(std::size_t first) const; // without its first elements
};

// Arguments of a kernel from `index` on: the buffers, and a Place or Places. Returns the next index.
cl_uint set_arg(cl::Kernel &kernel, cl_uint index, const DeviceArray &array);

// Elements first ... first + count - 1 of host arrays, count >= 1, as a device has them. Where the device shares the
// host's memory, arrays that have memory in common are one buffer on it; else, and where one would be larger than the
// device takes, each coordinate is copied.
class MappedArrays {
  public:
    MappedArrays(Context &context, const std::vector<HostArray> &arrays, std::size_t first, std::size_t count);

    const std::vector<DeviceArray> &on_device() const { return on_device_; }

    // Brings what was written back to the host. To be called when the kernels have ended.
    void finish();

  private:
    // Memory from the first float that some arrays have to the last.
    struct Region {
        float *begin, *end;
        bool is_written;
        cl::Buffer buffer;
        std::size_t bytes() const { return static_cast<std::size_t>(end - begin) * sizeof(float); }
    };
    // A coordinate that is copied.
    struct Copy {
        float *host;
        std::size_t stride;
        bool is_written;
        cl::Buffer buffer;
    };

    bool can_share(const std::vector<HostArray> &arrays, std::size_t first);
    void share(const std::vector<HostArray> &arrays, std::size_t first);
    void copy(const std::vector<HostArray> &arrays, std::size_t first);
    DeviceArray dropped(const HostArray &array) const;

    Context &context_;
    std::size_t count_;
    std::vector<Region> regions_;
    std::vector<Copy> copies_;
    std::vector<DeviceArray> on_device_;
};

} // namespace smx
