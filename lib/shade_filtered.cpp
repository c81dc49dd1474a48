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
template <typename Real>
struct DeviceLobe {
    Real weight, alpha2, exponent_1, exponent_2, peak;
};

// Each lobe's variances plus X's, along X's principal axes.
template <typename Real>
std::vector<DeviceLobe<Real>> widened_lobes(const Material &material, const Displacement &x) {
    const PrincipalAxes axes = principal_axes(x);
    const auto r = [](double v) { return static_cast<Real>(v); };
    std::vector<DeviceLobe<Real>> lobes;
    for (const auto &[share, alpha] : material.lobes) {
        const double weight = material.model == Model::Shared ? share : 1.0;
        const double alpha2 = alpha * alpha, var_1 = alpha2 + axes.var_1, var_2 = alpha2 + axes.var_2;
        const double peak = weight / (std::numbers::pi * std::sqrt(var_1) * std::sqrt(var_2));
        lobes.push_back(
            {r(weight), r(alpha2), r(-std::numbers::log2e / var_1), r(-std::numbers::log2e / var_2), r(peak)});
    }
    return lobes;
}

cl::Buffer lobe_buffer(const Context &context, const Material &material, const Displacement &x, Grade grade) {
    return with_real(grade,
                     [&](auto real) { return buffer_from(context, widened_lobes<decltype(real)>(material, x)); });
}

Defines defines(Model model, Masking masking, Grade grade) {
    return {{"PER_LOBE", model == Model::PerLobe},
            {"G2_SEPARABLE", masking == Masking::Separable},
            {"GRADE", static_cast<int>(grade)}};
}

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
    const Grade grade = options.grade;
    const cl::Buffer fresnel = fresnel_at_angle(device, material, theta_d(scene), grade);
    const cl::Buffer rgba = empty_buffer<cl_float4>(device, std::size_t{most_rows} * scene.width);
    const cl::Buffer lobes = lobe_buffer(device, material, scene.displacement, grade);
    cl::Kernel kernel =
        device.kernel(kernel_file, "shade_filtered_sphere", defines(material.model, scene.masking, grade));
    kernel.setArg(0, rgba);
    set_arg(kernel, 1, scene, grade);
    set_arg(kernel, 3, scene.displacement, grade);
    kernel.setArg(4, lobes);
    kernel.setArg(5, static_cast<cl_int>(material.lobes.size()));
    kernel.setArg(6, fresnel);
    const std::size_t columns = round_up(scene.width, device.width()) / device.width();
    // A kernel does not keep its buffers alive.
    return [&device, &scene, &options, rgba, kernel, columns, kept = std::array{fresnel, lobes}](
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
    validate(options.grade, context);
    Attributes attributes = describe("filtered", scene);
    attributes["slopemix.material"] = material.name;
    attributes["slopemix.model"] = model_name(material.model);
    attributes["slopemix.grade"] = grade_name(options.grade);
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
    constexpr Grade grade = Grade::Precise;
    const cl::Buffer out = empty_buffer<float>(context, 3 * stride);
    const cl::Buffer wi_buffer = buffer_from(context, to_planes(wi, count, stride));
    const cl::Buffer wo_buffer = buffer_from(context, to_planes(wo, count, stride));
    const cl::Buffer lobes = lobe_buffer(context, material, displacement, grade);
    const cl::Buffer curves = buffer_from(context, packed_curves(material));
    const cl::Buffer knots = buffer_from(context, packed_knots(material));
    cl::Kernel kernel = context.kernel(kernel_file, "shade_filtered_pairs", defines(material.model, masking, grade));
    kernel.setArg(0, out);
    kernel.setArg(1, static_cast<cl_int>(stride));
    kernel.setArg(2, wi_buffer);
    kernel.setArg(3, wo_buffer);
    set_arg(kernel, 4, displacement, grade);
    kernel.setArg(5, lobes);
    kernel.setArg(6, static_cast<cl_int>(material.lobes.size()));
    kernel.setArg(7, curves);
    kernel.setArg(8, knots);
    kernel.setArg(9, static_cast<cl_int>(material.theta_d.size()));
    context.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(stride / context.width()));

    std::vector<float> planes(3 * stride);
    context.queue().enqueueReadBuffer(out, CL_TRUE, 0, planes.size() * sizeof(float), planes.data());
    from_planes(planes, count, fcos);
}

} // namespace smx
