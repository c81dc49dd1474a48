// slopemix_opencl.h
#include "slopemix_opencl.h"

#include <vector>

#include "evaluator_handle.h"

using namespace smx;

namespace {

// Throws InvalidArgument unless a buffer of the context's holds elements 0 ... count - 1 from `offset` on.
void require_inside(const cl::Buffer &buffer, const Context &context, std::size_t count, std::size_t offset,
                    std::size_t stride, const char *name) {
    require(buffer.getInfo<CL_MEM_CONTEXT>()() == context.cl()(), name,
            " is a buffer of another cl_context than the evaluator's");
    const std::size_t floats = buffer.getInfo<CL_MEM_SIZE>() / sizeof(float);
    const bool inside = offset < floats && (count - 1) <= (floats - 1 - offset) / stride;
    require(inside, name, " has ", floats, " floats; offset ", offset, ", stride ", stride, " and count ", count,
            " go beyond");
}

DeviceArray checked(const Context &context, std::size_t count, std::vector<cl_mem> in,
                    const std::array<std::size_t, 3> &offsets, std::size_t stride, const char *name) {
    require(stride >= 1, name, "->stride is 0; it must be at least 1");
    DeviceArray array{in.size(), {}, {}, stride};
    for (std::size_t c = 0; c < in.size(); ++c) {
        require(in[c] != nullptr, name, " has a buffer that is null");
        array.in[c] = cl::Buffer(in[c], true);
        array.offset[c] = offsets[c];
        if (count > 0) require_inside(array.in[c], context, count, offsets[c], stride, name);
    }
    return array;
}

DeviceArray array_of(const Context &context, std::size_t count, const smx_cl_vectors *v, const char *name) {
    require_pointer(v, name);
    return checked(context, count, {v->x, v->y, v->z}, {v->x_offset, v->y_offset, v->z_offset}, v->stride, name);
}

DeviceArray array_of(const Context &context, std::size_t count, const smx_cl_scalars *s, const char *name) {
    require_pointer(s, name);
    return checked(context, count, {s->values}, {s->offset, 0, 0}, s->stride, name);
}

std::vector<cl::Event> events_of(cl_uint wait_count, const cl_event *wait) {
    require(wait_count == 0 || wait, "wait is null and wait_count ", wait_count);
    std::vector<cl::Event> events;
    for (cl_uint k = 0; k < wait_count; ++k) {
        require(wait[k] != nullptr, "wait[", k, "] is null");
        events.emplace_back(wait[k], true);
    }
    return events;
}

// What the functions have in common: arrays(context) are the quantity's, in its order.
template <typename Arrays>
void enqueue_all(smx_evaluator evaluator, Quantity quantity, std::size_t count, Arrays arrays, cl_uint wait_count,
                 const cl_event *wait, cl_event *event) {
    require_pointer(evaluator, "evaluator");
    const std::vector<DeviceArray> checked_arrays = arrays(*evaluator->context);
    cl::Event end = evaluator->object->enqueue(quantity, count, checked_arrays, events_of(wait_count, wait));
    if (!event) return;
    *event = end();
    end() = nullptr; // the caller's now
}

Quantity quantity_of(smx_quantity wanted, std::uint32_t legal, const char *list) {
    for (const auto &[bit, quantity] : quantity_bits)
        if (bit == static_cast<std::uint32_t>(wanted) && (bit & legal)) return quantity;
    fail(Fault::InvalidArgument, "quantity is ", static_cast<int>(wanted), "; it must be ", list);
}

} // namespace

extern "C" {

smx_status smx_context_get_opencl(smx_context context, cl_context *cl_context_out, cl_command_queue *cl_queue_out,
                                  cl_device_id *cl_device_out) {
    return guarded([&] {
        require_pointer(context, "context");
        const Context &c = *context->object;
        if (cl_context_out) *cl_context_out = c.cl()();
        if (cl_queue_out) *cl_queue_out = c.queue()();
        if (cl_device_out) *cl_device_out = c.queue().getInfo<CL_QUEUE_DEVICE>()();
    });
}

smx_status smx_enqueue_eval(smx_evaluator evaluator, size_t count, const smx_cl_vectors *wi, const smx_cl_vectors *wo,
                            const smx_cl_vectors *fcos, cl_uint wait_count, const cl_event *wait, cl_event *event) {
    const auto arrays = [&](const Context &c) -> std::vector<DeviceArray> {
        const DeviceArray to_light = array_of(c, count, wi, "wi"), to_viewer = array_of(c, count, wo, "wo");
        return {array_of(c, count, fcos, "fcos"), to_light, to_viewer};
    };
    return guarded([&] { enqueue_all(evaluator, Quantity::Fcos, count, arrays, wait_count, wait, event); });
}

smx_status smx_enqueue_sample(smx_evaluator evaluator, size_t count, const smx_cl_vectors *u, const smx_cl_vectors *wo,
                              const smx_cl_vectors *wi, const smx_cl_scalars *pdf, cl_uint wait_count,
                              const cl_event *wait, cl_event *event) {
    const auto arrays = [&](const Context &c) -> std::vector<DeviceArray> {
        const DeviceArray uniform = array_of(c, count, u, "u"), to_viewer = array_of(c, count, wo, "wo");
        const DeviceArray drawn = array_of(c, count, wi, "wi");
        return {drawn, array_of(c, count, pdf, "pdf"), uniform, to_viewer};
    };
    return guarded([&] { enqueue_all(evaluator, Quantity::Sample, count, arrays, wait_count, wait, event); });
}

smx_status smx_enqueue_of_pairs(smx_evaluator evaluator, smx_quantity quantity, size_t count, const smx_cl_vectors *wi,
                                const smx_cl_vectors *wo, const smx_cl_scalars *values, cl_uint wait_count,
                                const cl_event *wait, cl_event *event) {
    return guarded([&] {
        const Quantity q =
            quantity_of(quantity, SMX_QUANTITY_PDF | SMX_QUANTITY_G2, "SMX_QUANTITY_PDF or SMX_QUANTITY_G2");
        const auto arrays = [&](const Context &c) -> std::vector<DeviceArray> {
            const DeviceArray to_light = array_of(c, count, wi, "wi"), to_viewer = array_of(c, count, wo, "wo");
            return {array_of(c, count, values, "values"), to_light, to_viewer};
        };
        enqueue_all(evaluator, q, count, arrays, wait_count, wait, event);
    });
}

smx_status smx_enqueue_of_directions(smx_evaluator evaluator, smx_quantity quantity, size_t count,
                                     const smx_cl_vectors *k, const smx_cl_scalars *values, cl_uint wait_count,
                                     const cl_event *wait, cl_event *event) {
    return guarded([&] {
        const Quantity q = quantity_of(quantity, SMX_QUANTITY_NDF | SMX_QUANTITY_SIGMA | SMX_QUANTITY_G1,
                                       "SMX_QUANTITY_NDF, SMX_QUANTITY_SIGMA or SMX_QUANTITY_G1");
        const auto arrays = [&](const Context &c) -> std::vector<DeviceArray> {
            const DeviceArray directions = array_of(c, count, k, "k");
            return {array_of(c, count, values, "values"), directions};
        };
        enqueue_all(evaluator, q, count, arrays, wait_count, wait, event);
    });
}
}
