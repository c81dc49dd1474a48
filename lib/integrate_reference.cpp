#include "integrate_reference.h"

#include <algorithm>
#include <cmath>

#include "device_buffer.h"
#include "error.h"
#include "table_slice.h"

namespace smx {

namespace {

constexpr const char *kernel_file = "integrate_reference.cl";
constexpr std::uint32_t max_spp = 1u << 24;

// Facets drawn and integrated per launch: a whole number of the kernel's summation blocks, so that the sums do not depend
// on it, and few enough that progress is told and a cancel heard several times a second.
constexpr std::uint32_t summation_block = 256;
constexpr std::uint64_t launch_evaluations = 1u << 26;

std::uint32_t facets_per_launch(const Scene &scene, std::uint32_t samples) {
    const std::uint64_t wanted = launch_evaluations / band_pixels(scene) / summation_block * summation_block;
    const std::uint64_t most = std::clamp<std::uint64_t>(wanted, summation_block, 1u << 18);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(most, samples));
}

// Strata along X's principal axes: n x n, or all of them along the one axis that has any roughness.
struct Strata {
    cl_uint first, second;
    std::uint32_t samples() const { return first * second; }
};

Strata grid_strata(const Displacement &x, std::uint32_t spp) {
    const PrincipalAxes axes = principal_axes(x);
    if (axes.var_1 == 0.0 && axes.var_2 == 0.0) return {1, 1};
    if (axes.var_2 == 0.0) return {spp, 1};
    if (axes.var_1 == 0.0) return {1, spp};
    const auto side = static_cast<cl_uint>(std::lround(std::sqrt(static_cast<double>(spp))));
    return {side, side};
}

cl_uint folded_seed(std::uint64_t seed) { return static_cast<cl_uint>(seed ^ (seed >> 32)); }

void validate(const RenderOptions &o) {
    require(o.sampler == Sampler::Grid, "sampler is ", static_cast<int>(o.sampler), "; it must be 0 (grid)");
    require(o.lookup == Lookup::Linear || o.lookup == Lookup::Nearest, "lookup is ", static_cast<int>(o.lookup),
            "; it must be 0 or 1");
    require(o.spp >= 1 && o.spp <= max_spp, "spp is ", o.spp, "; it must be 1..", max_spp);
    const auto side = std::lround(std::sqrt(static_cast<double>(o.spp)));
    require(side * side == static_cast<long>(o.spp), "spp is ", o.spp, "; the grid needs a square, such as ",
            side * side);
}

// The kernels of one image, and the buffers that they share.
class Integration {
  public:
    Integration(Context &context, const Brdf &brdf, const Scene &scene, const RenderOptions &options);
    void integrate(const Band &band, Image &image, const std::function<void(double)> &progress);
    double kernel_seconds() const { return time_.seconds(); }
    std::uint32_t samples() const { return strata_.samples(); }

  private:
    void launch(cl::Kernel &kernel, const cl::NDRange &range);
    void draw(std::uint32_t first, std::uint32_t size);
    void clear_sums();

    Context &context_;
    const Scene &scene_;
    Strata strata_;
    std::uint32_t per_launch_, stride_;
    cl::Buffer facets_, slice_, sums_, rests_, rgba_;
    cl::Kernel draw_, integrate_, finish_;
    KernelTime time_;
    bool drawn_ = false;
};

Integration::Integration(Context &context, const Brdf &brdf, const Scene &scene, const RenderOptions &options)
    : context_(context),
      scene_(scene),
      strata_(grid_strata(scene.displacement, options.spp)),
      per_launch_(facets_per_launch(scene, strata_.samples())),
      stride_(static_cast<std::uint32_t>(round_up(per_launch_, context.width()))),
      facets_(empty_buffer<float>(context, 4 * std::size_t{stride_})),
      slice_(buffer_from(context, table_slice(brdf, theta_d(scene), options.lookup))),
      sums_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      rests_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      rgba_(empty_buffer<cl_float4>(context, band_pixels(scene))) {
    const Defines defines = {{"G2_SEPARABLE", scene.masking == Masking::Separable},
                             {"LOOKUP_NEAREST", options.lookup == Lookup::Nearest}};
    const DeviceDisplacement x = to_device(scene.displacement);
    const DeviceView view = to_device(scene);

    draw_ = context.kernel("draw_slopes.cl", "draw_slopes");
    draw_.setArg(0, facets_);
    draw_.setArg(1, static_cast<cl_int>(stride_));
    draw_.setArg(3, strata_.first);
    draw_.setArg(4, strata_.second);
    draw_.setArg(5, folded_seed(options.seed));
    draw_.setArg(6, x);

    integrate_ = context.kernel(kernel_file, "integrate_reference", defines);
    integrate_.setArg(0, sums_);
    integrate_.setArg(1, rests_);
    integrate_.setArg(2, view);
    integrate_.setArg(4, slice_);
    integrate_.setArg(5, facets_);
    integrate_.setArg(6, static_cast<cl_int>(stride_));

    finish_ = context.kernel(kernel_file, "finish_reference", defines);
    finish_.setArg(0, rgba_);
    finish_.setArg(1, sums_);
    finish_.setArg(2, rests_);
    finish_.setArg(3, view);
    finish_.setArg(5, x);
    finish_.setArg(6, 1.0f / static_cast<float>(strata_.samples()));
}

void Integration::launch(cl::Kernel &kernel, const cl::NDRange &range) {
    cl::Event event;
    context_.queue().enqueueNDRangeKernel(kernel, cl::NullRange, range, cl::NullRange, nullptr, &event);
    time_.add(event);
}

void Integration::draw(std::uint32_t first, std::uint32_t size) {
    const bool all_at_once = size == strata_.samples();
    if (all_at_once && drawn_) return;  // the facets of the last band are those of this one
    draw_.setArg(2, static_cast<cl_uint>(first));
    launch(draw_, cl::NDRange(size));
    drawn_ = true;
}

void Integration::clear_sums() {
    const std::size_t bytes = band_pixels(scene_) * sizeof(cl_float4);
    context_.queue().enqueueFillBuffer(sums_, 0.0f, 0, bytes);
    context_.queue().enqueueFillBuffer(rests_, 0.0f, 0, bytes);
}

void Integration::integrate(const Band &band, Image &image, const std::function<void(double)> &progress) {
    clear_sums();
    for (std::uint32_t first = 0; first < strata_.samples(); first += per_launch_) {
        const std::uint32_t size = std::min(per_launch_, strata_.samples() - first);
        draw(first, size);
        integrate_.setArg(3, static_cast<cl_int>(band.first_row));
        integrate_.setArg(7, static_cast<cl_int>(size));
        launch(integrate_, cl::NDRange(std::size_t{band.rows} * scene_.width));
        progress(static_cast<double>(first + size) / strata_.samples());
    }
    finish_.setArg(4, static_cast<cl_int>(band.first_row));
    launch(finish_, cl::NDRange(round_up(scene_.width, context_.width()) / context_.width(), band.rows));
    read_band(context_, rgba_, band, image);
}

}  // namespace

Rendered integrate_reference(Context &context, const Brdf &brdf, const Scene &scene, const RenderOptions &options) {
    validate(scene);
    validate(options);
    const auto lock = context.lock();
    const CallTimer timer(context);
    Rendered result{Image(scene.width, scene.height), {}};
    report_progress(options, 0.0);

    Integration integration(context, brdf, scene, options);
    for (const Band &band : bands(scene))
        integration.integrate(band, result.image, [&](double share) {
            report_progress(options, (band.first_row + share * band.rows) / scene.height);
        });

    describe(result.image, "reference", scene);
    auto &attributes = result.image.attributes;
    attributes["slopemix.brdf"] = brdf.name();
    attributes["slopemix.brdf_sha256"] = brdf.sha256();
    attributes["slopemix.sampler"] = "grid";
    attributes["slopemix.spp"] = std::to_string(options.spp);
    attributes["slopemix.seed"] = std::to_string(options.seed);
    attributes["slopemix.lookup"] = options.lookup == Lookup::Nearest ? "nearest" : "linear";
    result.report = timer.finish(context, integration.kernel_seconds(),
                                 sphere_pixels(scene) * integration.samples());
    return result;
}

}  // namespace smx
