#include "shade_uniform.h"

#include <atomic>

#include "device_buffer.h"
#include "error.h"
#include "filtered_kernels.h"
#include "filtered_material.h"
#include "light_lobes.h"
#include "packed_material.h"
#include "uniform_light.h"
#include "widening.h"

namespace smx {

namespace {

// Places of cl/shade_uniform.cl's own arguments, and of the count among what a kernel keeps.
constexpr cl_uint count_argument = first_own_argument + 5, widening_argument = first_own_argument + 6;
constexpr std::size_t kept_count = 3;

cl::Buffer light_lobe_buffer(const Context &device, const Material &material, const Displacement &x, Grade grade) {
    return with_real(grade, [&](auto real) { return buffer_from(device, light_lobes<decltype(real)>(material, x)); });
}

UniformKernel kernel_of(Context &device, const Simplified &simple, const std::vector<int> &orders, Grade grade) {
    const auto &[material, scene, on] = simple;
    FilteredKernels kernels(material, scene.displacement, on, orders, grade);
    if (!kernels.widened) kernels.defines["WIDENING"] = 0;
    UniformKernel own = {device.kernel("shade_uniform.cl", "shade_uniform", kernels.defines),
                         {light_lobe_buffer(device, material, scene.displacement, grade),
                          lobe_buffer(device, material, scene.displacement, grade),
                          buffer_from(device, packed(material)), make_counter(device)}};
    own.kernel.setArg(first_own_argument, own.kept[0]);
    own.kernel.setArg(first_own_argument + 1, static_cast<cl_int>(material.lobes.size()));
    own.kernel.setArg(first_own_argument + 2, own.kept[1]);
    own.kernel.setArg(first_own_argument + 3, static_cast<cl_int>(material.lobes.size()));
    own.kernel.setArg(first_own_argument + 4, own.kept[2]);
    own.kernel.setArg(count_argument, own.kept[kept_count]);
    if (kernels.widened)
        for (const cl::Buffer &buffer :
             set_widening(device, own.kernel, widening_argument, material, scene.displacement, orders, grade))
            own.kept.push_back(buffer);
    return own;
}

// Takes what a launch has counted, and begins anew.
std::uint64_t take_count(Context &device, const UniformKernel &own) {
    cl_int counted = 0;
    device.queue().enqueueReadBuffer(own.kept[kept_count], CL_TRUE, 0, sizeof counted, &counted);
    device.queue().enqueueFillBuffer(own.kept[kept_count], cl_int{0}, 0, sizeof counted);
    return static_cast<std::uint64_t>(counted);
}

} // namespace

Rendered shade_uniform(Context &context, const Material &material, const Scene &scene, const RenderOptions &options,
                       const Simulated &simulated) {
    validate(scene);
    RenderOptions of_sampler = options;
    of_sampler.sampler = Sampler::Sobol; // all directions are drawn alike
    validate(of_sampler);
    validate(options.grade, context);
    validate_widening(options);
    require(options.widening_order != widening_auto,
            "widening_order is -1 (auto); under a uniform light it must be 0..", max_widening_order);
    const Simplified simple = simplified(material, scene, simulated);
    const std::vector<int> orders = fixed_orders(simple.material, simple.scene.displacement, options.widening_order);
    const std::vector<int> all_orders = with_dropped(orders, simulated.lobes);
    std::atomic<std::uint64_t> unsettled = 0;

    UniformImage image;
    image.start = [&](Context &device) { return kernel_of(device, simple, orders, options.grade); };
    image.finish_part = [&](Context &device, const UniformKernel &own) { unsettled += take_count(device, own); };
    image.describe = [&](std::uint32_t spp) {
        Attributes attributes = describe_filtered(material, scene, options, simulated, all_orders);
        attributes["slopemix.spp"] = std::to_string(spp);
        attributes["slopemix.scrambles"] = std::to_string(scrambles_of(spp, options.scrambles));
        attributes["slopemix.seed"] = std::to_string(options.seed);
        return attributes;
    };
    Rendered rendered = render_uniform(context, scene, simple.scene.displacement, options, image);
    RenderReport &report = rendered.report;
    report.orders = all_orders;
    report.effects = simulated.on;
    report.lobes = simple.material.lobes.size();
    report.unsettled =
        report.evaluations == 0 ? 0.0 : static_cast<double>(unsettled) / static_cast<double>(report.evaluations);
    return rendered;
}

} // namespace smx
