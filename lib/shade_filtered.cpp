#include "shade_filtered.h"

#include <array>
#include <cmath>
#include <numbers>

#include "device_buffer.h"
#include "direction_pairs.h"
#include "error.h"

namespace smx {

namespace {

constexpr const char *kernel_file = "shade_filtered.cl";

// As in cl/mixture.clh.
struct DeviceLobe {
    float weight, alpha2, inv_var_1, inv_var_2, peak;
};

// Each lobe's variances plus X's, along X's principal axes.
std::vector<DeviceLobe> widened_lobes(const Material &material, const Displacement &x) {
    const PrincipalAxes axes = principal_axes(x);
    std::vector<DeviceLobe> lobes;
    for (const auto &[share, alpha] : material.lobes) {
        const double weight = material.model == Model::Shared ? share : 1.0;
        const double alpha2 = alpha * alpha, var_1 = alpha2 + axes.var_1, var_2 = alpha2 + axes.var_2;
        const double peak = weight / (std::numbers::pi * std::sqrt(var_1) * std::sqrt(var_2));
        lobes.push_back({static_cast<float>(weight), static_cast<float>(alpha2), static_cast<float>(1.0 / var_1),
                         static_cast<float>(1.0 / var_2), static_cast<float>(peak)});
    }
    return lobes;
}

Defines defines(Model model, Masking masking) {
    return {{"PER_LOBE", model == Model::PerLobe}, {"G2_SEPARABLE", masking == Masking::Separable}};
}

// F at one angle, one entry per set of curves.
std::vector<cl_float4> fresnel_at_angle(const Material &material, double theta_d) {
    std::vector<cl_float4> values;
    for (const FresnelCurves &curves : material.fresnel) {
        const Rgb f = fresnel_at(material.theta_d, curves, theta_d);
        values.push_back({{static_cast<float>(f[0]), static_cast<float>(f[1]), static_cast<float>(f[2]), 0.0f}});
    }
    return values;
}

// All curves, as cl/fresnel.clh reads them.
std::vector<float> packed_curves(const Material &material) {
    std::vector<float> packed;
    for (const FresnelCurves &curves : material.fresnel)
        for (const std::vector<double> &curve : curves)
            for (double f : curve) packed.push_back(static_cast<float>(f));
    return packed;
}

// The knots over pi/2.
std::vector<float> packed_knots(const Material &material) {
    std::vector<float> knots;
    for (double angle : material.theta_d) knots.push_back(static_cast<float>(angle / (std::numbers::pi / 2)));
    return knots;
}

} // namespace

namespace {

// What one device does with a tile of the sphere.
RenderRows start_sphere(Context &device, const Material &material, const Scene &scene, const RenderOptions &options,
                        std::uint32_t most_rows) {
    const std::vector<DeviceLobe> lobes = widened_lobes(material, scene.displacement);
    const cl::Buffer fresnel = buffer_from(device, fresnel_at_angle(material, theta_d(scene)));
    const cl::Buffer rgba = empty_buffer<cl_float4>(device, std::size_t{most_rows} * scene.width);
    const cl::Buffer lobe_buffer = buffer_from(device, lobes);
    cl::Kernel kernel = device.kernel(kernel_file, "shade_filtered_sphere", defines(material.model, scene.masking));
    kernel.setArg(0, rgba);
    kernel.setArg(1, to_device(scene));
    kernel.setArg(3, to_device(scene.displacement));
    kernel.setArg(4, lobe_buffer);
    kernel.setArg(5, static_cast<cl_int>(lobes.size()));
    kernel.setArg(6, fresnel);
    const std::size_t columns = round_up(scene.width, device.width()) / device.width();
    // A kernel does not keep its buffers alive.
    return [&device, &scene, &options, rgba, kernel, columns, kept = std::array{fresnel, lobe_buffer}](
               const Tile &tile, const TileRows &to, const Step &) mutable {
        kernel.setArg(2, static_cast<cl_int>(tile.first_row));
        const double seconds = launch(device, kernel, columns, tile.rows, options.tiling.work_group);
        read_rows(device, rgba, std::size_t{tile.rows} * scene.width, to.rgba);
        return seconds;
    };
}

} // namespace

Rendered shade_filtered(Context &context, const Material &material, const Scene &scene, const RenderOptions &options) {
    validate(scene);
    Attributes attributes = describe("filtered", scene);
    attributes["slopemix.material"] = material.name;
    attributes["slopemix.model"] = model_name(material.model);
    attributes["slopemix.lobes"] = std::to_string(material.lobes.size());
    return render_once(context, scene, options, attributes, [&](Context &device, std::uint32_t most_rows) {
        return start_sphere(device, material, scene, options, most_rows);
    });
}

void shade_filtered_pairs(Context &context, const Material &material, const Displacement &displacement, Masking masking,
                          std::size_t count, const float *wi, const float *wo, float *fcos) {
    validate(displacement);
    require(masking == Masking::Correlated || masking == Masking::Separable, "masking is ", static_cast<int>(masking),
            "; it must be 0 or 1");
    require_pair_count(count);
    const std::size_t stride = round_up(count, context.width());
    if (count == 0) return;

    const Context::Lock lock(context);
    const std::vector<DeviceLobe> lobes = widened_lobes(material, displacement);
    const cl::Buffer out = empty_buffer<float>(context, 3 * stride);
    const cl::Buffer wi_buffer = buffer_from(context, to_planes(wi, count, stride));
    const cl::Buffer wo_buffer = buffer_from(context, to_planes(wo, count, stride));
    const cl::Buffer lobe_buffer = buffer_from(context, lobes);
    const cl::Buffer curves = buffer_from(context, packed_curves(material));
    const cl::Buffer knots = buffer_from(context, packed_knots(material));
    cl::Kernel kernel = context.kernel(kernel_file, "shade_filtered_pairs", defines(material.model, masking));
    kernel.setArg(0, out);
    kernel.setArg(1, static_cast<cl_int>(stride));
    kernel.setArg(2, wi_buffer);
    kernel.setArg(3, wo_buffer);
    kernel.setArg(4, to_device(displacement));
    kernel.setArg(5, lobe_buffer);
    kernel.setArg(6, static_cast<cl_int>(lobes.size()));
    kernel.setArg(7, curves);
    kernel.setArg(8, knots);
    kernel.setArg(9, static_cast<cl_int>(material.theta_d.size()));
    context.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(stride / context.width()));

    std::vector<float> planes(3 * stride);
    context.queue().enqueueReadBuffer(out, CL_TRUE, 0, planes.size() * sizeof(float), planes.data());
    from_planes(planes, count, fcos);
}

} // namespace smx
