#include "eval_table.h"

#include "device_buffer.h"
#include "direction_pairs.h"
#include "error.h"
#include "table_whole.h"

namespace smx {

void eval_table(Context &context, const Brdf &brdf, Lookup lookup, std::size_t count, const float *wi, const float *wo,
                float *f) {
    require(lookup == Lookup::Linear || lookup == Lookup::Nearest, "lookup is ", static_cast<int>(lookup),
            "; it must be 0 or 1");
    require_pair_count(count);
    if (count == 0) return;

    const Context::Lock lock(context);
    const std::size_t stride = round_up(count, context.width());
    const cl::Buffer out = empty_buffer<float>(context, 3 * stride);
    const cl::Buffer wi_buffer = buffer_from(context, to_planes(wi, count, stride));
    const cl::Buffer wo_buffer = buffer_from(context, to_planes(wo, count, stride));
    const cl::Buffer table = buffer_from(context, table_whole(brdf));
    cl::Kernel kernel = context.kernel("eval_table.cl", "eval_table", {{"LOOKUP_NEAREST", lookup == Lookup::Nearest}});
    kernel.setArg(0, out);
    kernel.setArg(1, static_cast<cl_int>(stride));
    kernel.setArg(2, wi_buffer);
    kernel.setArg(3, wo_buffer);
    kernel.setArg(4, table);
    context.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(stride / context.width()));

    std::vector<float> planes(3 * stride);
    context.queue().enqueueReadBuffer(out, CL_TRUE, 0, planes.size() * sizeof(float), planes.data());
    from_planes(planes, count, f);
}

} // namespace smx
