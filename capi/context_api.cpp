// smx_device_*, smx_context_*
#include <vector>

#include "handles.h"

using namespace smx;

namespace {

void fill(smx_device_info &out, const DeviceInfo &in) {
    out.index = in.index;
    copy_text(out.name, in.name);
    copy_text(out.vendor, in.vendor);
    copy_text(out.version, in.version);
    copy_text(out.driver, in.driver);
    copy_text(out.platform, in.platform);
    copy_text(out.platform_version, in.platform_version);
    out.compute_units = in.compute_units;
    out.global_memory = in.global_memory;
    out.vector_width = in.vector_width;
    out.devices = in.devices;
}

std::shared_ptr<Context> context_of_device(const smx_context_options &o) {
    return std::make_shared<Context>(o.device ? o.device : "", o.vector_width, o.sub_devices);
}

std::shared_ptr<Context> context_of_queue(const smx_context_options &o) {
    require(!o.device, "device must be null when cl_context is given: the queue has its device");
    require(o.sub_devices <= 1, "sub_devices is ", o.sub_devices, "; it must be 0 or 1 when cl_context is given");
    const cl::Context context(static_cast<cl_context>(o.cl_context), true);
    const cl::CommandQueue queue(static_cast<cl_command_queue>(o.cl_queue), true);
    return std::make_shared<Context>(context, queue, o.vector_width);
}

std::shared_ptr<Context> make_context(const smx_context_options &o) {
    require(!o.cl_context == !o.cl_queue, "cl_context and cl_queue must both be given or both be null");
    std::shared_ptr<Context> context = o.cl_context ? context_of_queue(o) : context_of_device(o);
    if (o.copy_arrays) context->copy_arrays();
    return context;
}

} // namespace

extern "C" {

smx_status smx_device_count(uint32_t *count) {
    return guarded([&] {
        require_pointer(count, "count");
        *count = static_cast<uint32_t>(all_devices().size());
    });
}

smx_status smx_device_get_info(uint32_t index, smx_device_info *info) {
    return guarded([&] {
        check_output(info, "info");
        fill(*info, device_info(choose_device(std::to_string(index))));
    });
}

smx_status smx_context_create(const smx_context_options *options, smx_context *context) {
    return guarded([&] {
        require_pointer(context, "context");
        *context = new smx_context_s(make_context(checked(options, SMX_CONTEXT_OPTIONS_INIT, "options")));
    });
}

smx_status smx_context_retain(smx_context context) { return retain(context, "context"); }
void smx_context_release(smx_context context) { release(context); }

smx_status smx_context_get_info(smx_context context, smx_device_info *info) {
    return guarded([&] {
        require_pointer(context, "context");
        check_output(info, "info");
        fill(*info, context->object->info());
        info->build_seconds = context->object->build_seconds();
    });
}
}
