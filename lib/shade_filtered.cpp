#include "shade_filtered.h"

#include <algorithm>
#include <atomic>

#include "choose_orders.h"
#include "device_buffer.h"
#include "direction_pairs.h"
#include "filtered_kernels.h"
#include "filtered_material.h"
#include "shade_uniform.h"
#include "widening.h"

namespace smx {

namespace {

// F at one angle, one entry (r, g, b, 0) per set of curves.
cl::Buffer fresnel_at_angle(const Context &context, const Material &material, double theta_d, Grade grade) {
    return with_real(grade, [&](auto real) {
        std::vector<decltype(real)> values;
        for (const FresnelCurves &curves : material.fresnel) {
            for (double f : fresnel_at(material.theta_d, curves, theta_d))
                values.push_back(static_cast<decltype(real)>(f));
            values.push_back(0);
        }
        return buffer_from(context, values);
    });
}

// What one device does with a tile of the sphere. Adds to `unsettled`.
RenderRows start_sphere(Context &device, const Simplified &simple, const RenderOptions &options,
                        const std::vector<int> &orders, std::uint32_t most_rows,
                        std::atomic<std::uint64_t> &unsettled) {
    const auto &[material, scene, on] = simple;
    const Grade grade = options.grade;
    FilteredKernels kernels(material, scene.displacement, on, orders, grade);
    kernels.defines.erase("FRESNEL"); // of one theta_d: in the data alone
    const cl::Buffer fresnel = fresnel_at_angle(device, material, theta_d(scene), grade);
    const cl::Buffer rgba = empty_buffer<cl_float4>(device, std::size_t{most_rows} * scene.width);
    const cl::Buffer lobes = lobe_buffer(device, material, scene.displacement, grade);
    cl::Kernel kernel = kernels.kernel(device, "sphere");
    kernel.setArg(0, rgba);
    set_arg(kernel, 1, scene, grade);
    set_arg(kernel, 3, scene.displacement, grade);
    kernel.setArg(4, lobes);
    kernel.setArg(5, static_cast<cl_int>(material.lobes.size()));
    kernel.setArg(6, fresnel);
    // A kernel does not keep its buffers alive.
    std::vector<cl::Buffer> kept = {fresnel, lobes};
    cl::Buffer count;
    if (kernels.widened) {
        for (const cl::Buffer &buffer : set_widening(device, kernel, 7, material, scene.displacement, orders, grade))
            kept.push_back(buffer);
        count = make_counter(device);
        kernel.setArg(10, count);
    }
    const std::size_t columns = round_up(scene.width, device.width()) / device.width();
    return [&device, &options, &unsettled, width = scene.width, rgba, kernel, columns, kept, count](
               const Tile &tile, const TileRows &to, const Step &) mutable {
        if (count()) device.queue().enqueueFillBuffer(count, cl_int{0}, 0, sizeof(cl_int));
        kernel.setArg(2, static_cast<cl_int>(tile.first_row));
        const double seconds = launch(device, kernel, columns, tile.rows, options.tiling.work_group);
        read_rows(device, rgba, std::size_t{tile.rows} * width, to.rgba);
        cl_int counted = 0;
        if (count()) device.queue().enqueueReadBuffer(count, CL_TRUE, 0, sizeof counted, &counted);
        unsettled += static_cast<std::uint64_t>(counted);
        return seconds;
    };
}

} // namespace

Rendered shade_filtered(Context &context, const Material &material, const Scene &scene, const RenderOptions &options,
                        const Simulated &simulated) {
    if (scene.light == Light::Uniform) return shade_uniform(context, material, scene, options, simulated);
    validate(scene);
    validate(options.grade, context);
    validate_widening(options);
    const Simplified simple = simplified(material, scene, simulated);
    const auto [orders, choice] = widening_orders(context, simple.material, simple.scene, simple.on, options);
    const std::vector<int> all_orders = with_dropped(orders, simulated.lobes);
    const Attributes attributes = describe_filtered(material, scene, options, simulated, all_orders);
    std::atomic<std::uint64_t> unsettled = 0;
    Rendered rendered = render_once(context, scene, options, attributes,
                                    [&, &orders = orders](Context &device, std::uint32_t most_rows) {
                                        return start_sphere(device, simple, options, orders, most_rows, unsettled);
                                    });
    rendered.report.orders = all_orders;
    rendered.report.effects = simulated.on;
    rendered.report.lobes = simple.material.lobes.size();
    add_times(rendered.report, choice);
    const std::uint64_t lit = lit_pixels(scene);
    rendered.report.unsettled = lit == 0 ? 0.0 : static_cast<double>(unsettled) / static_cast<double>(lit);
    return rendered;
}

LobeValues eval_lobes(Context &context, const Material &material, const std::vector<int> &orders, const Scene &scene,
                      Effects on, Grade grade, std::size_t count, const float *wi, const float *wo) {
    const std::size_t stride = round_up(count, context.width());
    const FilteredKernels kernels(material, scene.displacement, on, orders, grade);
    const cl::Buffer out = empty_buffer<float>(context, orders.size() * stride);
    const cl::Buffer wi_buffer = buffer_from(context, to_planes(wi, count, stride));
    const cl::Buffer wo_buffer = buffer_from(context, to_planes(wo, count, stride));
    const cl::Buffer lobes = lobe_buffer(context, material, scene.displacement, grade);
    cl::Kernel kernel = context.kernel("shade_widened.cl", "probe_widening", kernels.defines);
    kernel.setArg(0, out);
    kernel.setArg(1, static_cast<cl_int>(stride));
    kernel.setArg(2, wi_buffer);
    kernel.setArg(3, wo_buffer);
    set_arg(kernel, 4, scene.displacement, grade);
    kernel.setArg(5, lobes);
    kernel.setArg(6, static_cast<cl_int>(material.lobes.size()));
    const auto kept = set_widening(context, kernel, 7, material, scene.displacement, orders, grade);
    LobeValues result;
    result.kernel_seconds = launch(context, kernel, stride / context.width(), orders.size(), 0);

    std::vector<float> padded(orders.size() * stride);
    context.queue().enqueueReadBuffer(out, CL_TRUE, 0, padded.size() * sizeof(float), padded.data());
    for (std::size_t entry = 0; entry < orders.size(); ++entry)
        result.values.insert(result.values.end(), padded.begin() + static_cast<std::ptrdiff_t>(entry * stride),
                             padded.begin() + static_cast<std::ptrdiff_t>(entry * stride + count));
    return result;
}

} // namespace smx
