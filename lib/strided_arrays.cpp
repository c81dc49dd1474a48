#include "strided_arrays.h"

#include <algorithm>

#include "device_buffer.h"

namespace smx {

namespace {

// As in cl/strided.clh.
struct DevicePlace {
    cl_ulong offset, stride;
};
struct DevicePlaces {
    cl_ulong x, y, z, stride;
};

// Nothing is written through what is only read.
float *unconst(const float *p) { return const_cast<float *>(p); }

} // namespace

HostArray read_vectors(const float *x, const float *y, const float *z, std::size_t stride) {
    return {3, {unconst(x), unconst(y), unconst(z)}, stride, false};
}

HostArray written_scalars(float *values, std::size_t stride) { return {1, {values, nullptr, nullptr}, stride, true}; }

HostArray written_vectors(float *x, float *y, float *z, std::size_t stride) { return {3, {x, y, z}, stride, true}; }

DeviceArray DeviceArray::from(std::size_t first) const {
    DeviceArray later = *this;
    for (cl_ulong &at : later.offset) at += first * stride;
    return later;
}

cl_uint set_arg(cl::Kernel &kernel, cl_uint index, const DeviceArray &array) {
    for (std::size_t c = 0; c < array.coordinates; ++c) kernel.setArg(index++, array.in[c]);
    if (array.coordinates == 1)
        kernel.setArg(index, DevicePlace{array.offset[0], array.stride});
    else
        kernel.setArg(index, DevicePlaces{array.offset[0], array.offset[1], array.offset[2], array.stride});
    return index + 1;
}

MappedArrays::MappedArrays(Context &context, const std::vector<HostArray> &arrays, std::size_t first, std::size_t count)
    : context_(context), count_(count) {
    if (context.shares_memory() && can_share(arrays, first))
        share(arrays, first);
    else
        copy(arrays, first);
}

// Finds the regions: joins what overlaps, since of a buffer on the host's memory no part may be in another.
bool MappedArrays::can_share(const std::vector<HostArray> &arrays, std::size_t first) {
    std::vector<Region> spans;
    for (const HostArray &array : arrays)
        for (std::size_t c = 0; c < array.coordinates && array.at[0]; ++c) {
            float *begin = array.at[c] + first * array.stride;
            spans.push_back({begin, begin + (count_ - 1) * array.stride + 1, array.is_written, {}});
        }
    std::sort(spans.begin(), spans.end(),
              [](const Region &a, const Region &b) { return std::less<>()(a.begin, b.begin); });
    std::vector<Region> joined;
    for (const Region &span : spans) {
        if (joined.empty() || !std::less<>()(span.begin, joined.back().end)) {
            joined.push_back(span);
            continue;
        }
        Region &last = joined.back();
        last.end = std::max(last.end, span.end, std::less<>());
        last.is_written = last.is_written || span.is_written;
    }
    const bool all_fit = std::all_of(joined.begin(), joined.end(),
                                     [&](const Region &r) { return r.bytes() <= context_.info().largest_buffer; });
    if (all_fit) regions_ = std::move(joined);
    return all_fit;
}

void MappedArrays::share(const std::vector<HostArray> &arrays, std::size_t first) {
    for (Region &r : regions_) r.buffer = shared_buffer(context_, r.bytes(), r.begin, r.is_written);

    // Every coordinate lies in one of them.
    for (const HostArray &array : arrays) {
        if (!array.at[0]) {
            on_device_.push_back(dropped(array));
            continue;
        }
        DeviceArray found{array.coordinates, {}, {}, array.stride};
        for (std::size_t c = 0; c < array.coordinates; ++c) {
            const float *begin = array.at[c] + first * array.stride;
            const auto region = std::find_if(regions_.begin(), regions_.end(), [&](const Region &r) {
                return !std::less<>()(begin, r.begin) && std::less<>()(begin, r.end);
            });
            found.in[c] = region->buffer;
            found.offset[c] = static_cast<cl_ulong>(begin - region->begin);
        }
        on_device_.push_back(found);
    }
}

DeviceArray MappedArrays::dropped(const HostArray &array) const {
    DeviceArray nowhere{array.coordinates, {}, {}, 1};
    for (std::size_t c = 0; c < array.coordinates; ++c) nowhere.in[c] = empty_buffer<float>(context_, count_);
    return nowhere;
}

void MappedArrays::copy(const std::vector<HostArray> &arrays, std::size_t first) {
    std::vector<float> plane(count_);
    for (const HostArray &array : arrays) {
        if (!array.at[0]) {
            on_device_.push_back(dropped(array));
            continue;
        }
        DeviceArray copied{array.coordinates, {}, {}, 1};
        for (std::size_t c = 0; c < array.coordinates; ++c) {
            float *host = array.at[c] + first * array.stride;
            if (!array.is_written)
                for (std::size_t k = 0; k < count_; ++k) plane[k] = host[k * array.stride];
            copied.in[c] = array.is_written ? empty_buffer<float>(context_, count_) : buffer_from(context_, plane);
            copies_.push_back({host, array.stride, array.is_written, copied.in[c]});
        }
        on_device_.push_back(copied);
    }
}

void MappedArrays::finish() {
    const cl::CommandQueue &queue = context_.queue();
    for (const Region &r : regions_) {
        if (!r.is_written) continue;
        void *mapped = queue.enqueueMapBuffer(r.buffer, CL_TRUE, CL_MAP_READ, 0, r.bytes());
        queue.enqueueUnmapMemObject(r.buffer, mapped);
    }
    std::vector<float> plane(count_);
    for (const Copy &c : copies_) {
        if (!c.is_written) continue;
        queue.enqueueReadBuffer(c.buffer, CL_TRUE, 0, count_ * sizeof(float), plane.data());
        for (std::size_t k = 0; k < count_; ++k) c.host[k * c.stride] = plane[k];
    }
    queue.finish(); // unmapped: the memory is the caller's again
}

} // namespace smx
