#include "integrate_reference.h"

#include <algorithm>
#include <cmath>

#include "device_buffer.h"
#include "error.h"
#include "sampling_plan.h"
#include "table_slice.h"

namespace smx {

namespace {

constexpr const char *kernel_file = "integrate_reference.cl", *drawing_file = "draw_facets.cl";

// Facets drawn and integrated per launch: a whole number of the kernel's summation blocks, so that the sums do not
// depend on it, and few enough that progress is told and a cancel heard several times a second.
constexpr std::uint32_t summation_block = 256;
constexpr std::uint64_t launch_evaluations = 1u << 26;
constexpr std::size_t facet_planes = 5; // the most that draw_facets.cl writes

std::uint32_t facets_per_launch(const Scene &scene, const SamplingPlan &plan) {
    const std::uint64_t wanted = launch_evaluations / band_pixels(scene) / summation_block * summation_block;
    const std::uint64_t most = std::clamp<std::uint64_t>(wanted, summation_block, 1u << 18);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(most, plan.samples_per_scramble()));
}

// The proposal as draw_about_z takes it: cumulated weights and alphas.
std::vector<cl_float2> cumulated(const std::vector<Lobe> &lobes) {
    std::vector<cl_float2> out;
    double sum = 0.0;
    for (const auto &[weight, alpha] : lobes)
        out.push_back({{static_cast<float>(sum += weight), static_cast<float>(alpha)}});
    if (out.empty()) out.push_back({{1.0f, 1.0f}}); // a buffer cannot be empty
    return out;
}

// Squares of the image and of its standard errors, over the pixels on the sphere.
struct ErrorSum {
    double value2 = 0.0, error2 = 0.0;

    void add(const float *rgba, const float *errors, std::size_t pixels) {
        for (std::size_t at = 0; at < 4 * pixels; ++at) {
            if (at % 4 == 3) continue;
            value2 += double{rgba[at]} * rgba[at];
            error2 += double{errors[at]} * errors[at];
        }
    }
    double relative() const { return error2 == 0.0 ? 0.0 : std::sqrt(error2 / value2); }
};

// The kernels of one image, and the buffers that they share.
class Integration {
  public:
    Integration(Context &context, const Brdf &brdf, const std::vector<Lobe> &proposal, const Scene &scene,
                const RenderOptions &options, std::uint32_t spp);
    void integrate(const Band &band, Image &image, const std::function<void(double)> &progress);
    const SamplingPlan &plan() const { return plan_; }
    double kernel_seconds() const { return time_.seconds(); }
    double standard_error() const { return plan_.scrambles > 1 ? errors_seen_.relative() : -1.0; }

  private:
    struct PassKernels {
        cl::Kernel draw, integrate;
    };
    PassKernels make_pass(const Pass &pass, const Defines &defines, const Displacement &x);
    void make_closing_kernels(const Defines &defines, const Displacement &x);
    void run_pass(std::size_t index, std::uint32_t scramble, const Band &band,
                  const std::function<void(std::uint32_t)> &done);
    void launch(cl::Kernel &kernel, const cl::NDRange &range);
    cl::NDRange pixels(const Band &band) const { return cl::NDRange(std::size_t{band.rows} * scene_.width); }

    Context &context_;
    const Scene &scene_;
    Grade grade_;
    std::uint64_t seed_;
    SamplingPlan plan_;
    std::uint32_t per_launch_, stride_;
    std::size_t proposal_size_;
    cl::Buffer facets_, slice_, lobes_, density_, sums_, rests_, means_, deviations_, rgba_, errors_;
    std::vector<PassKernels> passes_;
    cl::Kernel fold_, finish_;
    KernelTime time_;
    ErrorSum errors_seen_;
};

Integration::Integration(Context &context, const Brdf &brdf, const std::vector<Lobe> &proposal, const Scene &scene,
                         const RenderOptions &options, std::uint32_t spp)
    : context_(context),
      scene_(scene),
      grade_(options.grade),
      seed_(options.seed),
      plan_(sampling_plan(scene.displacement, options.sampler, spp)),
      per_launch_(facets_per_launch(scene, plan_)),
      stride_(static_cast<std::uint32_t>(round_up(per_launch_, context.width()))),
      proposal_size_(proposal.size()),
      facets_(empty_buffer<float>(context, facet_planes * stride_)),
      slice_(buffer_from(context, table_slice(brdf, theta_d(scene), options.lookup))),
      lobes_(buffer_from(context, cumulated(proposal))),
      density_(buffer_from(context, proposal_table(proposal))),
      sums_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      rests_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      means_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      deviations_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      rgba_(empty_buffer<cl_float4>(context, band_pixels(scene))),
      errors_(empty_buffer<cl_float4>(context, band_pixels(scene))) {
    const Defines defines = {{"GRADE", static_cast<int>(grade_)},
                             {"G2_SEPARABLE", scene.masking == Masking::Separable},
                             {"LOOKUP_NEAREST", options.lookup == Lookup::Nearest}};
    for (const Pass &pass : plan_.passes) passes_.push_back(make_pass(pass, defines, scene.displacement));
    make_closing_kernels(defines, scene.displacement);
    // Lanes past the last facet are computed and dropped, so what they read must be numbers.
    context.queue().enqueueFillBuffer(facets_, 0.0f, 0, facet_planes * stride_ * sizeof(float));
    const std::size_t bytes = band_pixels(scene) * sizeof(cl_float4);
    context.queue().enqueueFillBuffer(sums_, 0.0f, 0, bytes);
    context.queue().enqueueFillBuffer(rests_, 0.0f, 0, bytes);
}

Integration::PassKernels Integration::make_pass(const Pass &pass, const Defines &defines, const Displacement &x) {
    PassKernels kernels;
    const auto stride = static_cast<cl_int>(stride_);
    const char *names[] = {"draw_grid", "draw_sobol", "draw_about_z"};
    kernels.draw = context_.kernel(drawing_file, names[static_cast<int>(pass.drawing)]);
    kernels.draw.setArg(0, facets_);
    kernels.draw.setArg(1, stride);
    if (pass.drawing == Drawing::AboutZ) {
        kernels.draw.setArg(4, lobes_);
        kernels.draw.setArg(5, static_cast<cl_int>(proposal_size_));
        kernels.draw.setArg(6, density_);
    } else {
        kernels.draw.setArg(4, to_device(x));
    }
    if (pass.drawing == Drawing::Grid) {
        kernels.draw.setArg(5, static_cast<cl_uint>(pass.strata_1));
        kernels.draw.setArg(6, static_cast<cl_uint>(pass.strata_2));
    }

    Defines with_technique = defines;
    with_technique["TECHNIQUE"] = static_cast<int>(pass.technique);
    kernels.integrate = context_.kernel(kernel_file, "integrate_reference", with_technique);
    kernels.integrate.setArg(0, sums_);
    kernels.integrate.setArg(1, rests_);
    set_arg(kernels.integrate, 2, scene_, grade_);
    set_arg(kernels.integrate, 4, x, grade_);
    kernels.integrate.setArg(5, slice_);
    kernels.integrate.setArg(6, density_);
    kernels.integrate.setArg(7, facets_);
    kernels.integrate.setArg(8, stride);
    return kernels;
}

void Integration::make_closing_kernels(const Defines &defines, const Displacement &x) {
    Defines with_technique = defines;
    with_technique["TECHNIQUE"] = static_cast<int>(plan_.passes[0].technique); // any that is built already
    fold_ = context_.kernel(kernel_file, "fold_scramble", with_technique);
    fold_.setArg(0, sums_);
    fold_.setArg(1, rests_);
    fold_.setArg(2, means_);
    fold_.setArg(3, deviations_);
    fold_.setArg(4, 1.0f / static_cast<float>(plan_.samples_per_scramble()));

    finish_ = context_.kernel(kernel_file, "finish_reference", with_technique);
    finish_.setArg(0, rgba_);
    finish_.setArg(1, errors_);
    finish_.setArg(2, means_);
    finish_.setArg(3, deviations_);
    set_arg(finish_, 4, scene_, grade_);
    set_arg(finish_, 6, x, grade_);
    finish_.setArg(7, static_cast<cl_int>(plan_.scrambles));
}

void Integration::launch(cl::Kernel &kernel, const cl::NDRange &range) {
    cl::Event event;
    context_.queue().enqueueNDRangeKernel(kernel, cl::NullRange, range, cl::NullRange, nullptr, &event);
    time_.add(event);
}

void Integration::run_pass(std::size_t index, std::uint32_t scramble, const Band &band,
                           const std::function<void(std::uint32_t)> &done) {
    const std::uint32_t samples = plan_.passes[index].samples;
    PassKernels &kernels = passes_[index];
    for (std::uint32_t first = 0; first < samples; first += per_launch_) {
        const std::uint32_t size = std::min(per_launch_, samples - first);
        kernels.draw.setArg(2, static_cast<cl_uint>(first));
        kernels.draw.setArg(3, static_cast<cl_uint>(pass_seed(seed_, scramble, index)));
        launch(kernels.draw, cl::NDRange(size));
        kernels.integrate.setArg(3, static_cast<cl_int>(band.first_row));
        kernels.integrate.setArg(9, static_cast<cl_int>(size));
        launch(kernels.integrate, pixels(band));
        done(size);
    }
}

void Integration::integrate(const Band &band, Image &image, const std::function<void(double)> &progress) {
    std::uint64_t drawn = 0;
    for (std::uint32_t scramble = 0; scramble < plan_.scrambles; ++scramble) {
        for (std::size_t pass = 0; pass < passes_.size(); ++pass)
            run_pass(pass, scramble, band, [&](std::uint32_t size) {
                drawn += size;
                progress(static_cast<double>(drawn) / plan_.samples());
            });
        fold_.setArg(5, static_cast<cl_int>(scramble + 1));
        launch(fold_, pixels(band));
    }
    finish_.setArg(5, static_cast<cl_int>(band.first_row));
    launch(finish_, cl::NDRange(round_up(scene_.width, context_.width()) / context_.width(), band.rows));
    read_band(context_, rgba_, band, image);

    std::vector<float> errors(std::size_t{band.rows} * scene_.width * 4);
    context_.queue().enqueueReadBuffer(errors_, CL_TRUE, 0, errors.size() * sizeof(float), errors.data());
    const float *rows = image.rgba.data() + std::size_t{band.first_row} * scene_.width * 4;
    errors_seen_.add(rows, errors.data(), errors.size() / 4);
}

// One image at a fixed number of samples.
RenderReport integrate_image(Context &context, const Brdf &brdf, const std::vector<Lobe> &proposal, const Scene &scene,
                             const RenderOptions &options, std::uint32_t spp, Image &image) {
    Integration integration(context, brdf, proposal, scene, options, spp);
    for (const Band &band : bands(scene))
        integration.integrate(band, image, [&](double share) {
            report_progress(options, (band.first_row + share * band.rows) / scene.height);
        });
    RenderReport report;
    report.spp = integration.plan().samples();
    report.kernel_seconds = integration.kernel_seconds();
    report.evaluations = lit_pixels(scene) * report.spp;
    report.standard_error = integration.standard_error();
    return report;
}

// Samples for the next try, from the error of the last one. Scrambled Sobol points were measured to converge as their
// number to the -0.75 on these integrands; a tenth more, so that chance does not ask for another round; a power of two,
// as Sobol's points like it.
std::uint32_t next_spp(std::uint32_t spp, double error, double target) {
    const double wanted = spp * 1.1 * std::pow(error / target, 1.0 / 0.75);
    std::uint32_t next = 2 * spp;
    while (next < wanted && next < max_spp) next *= 2;
    return next;
}

bool draws_about_wh(const Scene &scene, const RenderOptions &options) {
    const std::vector<Pass> passes = sampling_plan(scene.displacement, options.sampler, options.spp).passes;
    return std::any_of(passes.begin(), passes.end(),
                       [](const Pass &pass) { return pass.technique == Technique::AboutWhBalanced; });
}

void describe_reference(Image &image, const Brdf &brdf, const Scene &scene, const RenderOptions &options,
                        const RenderReport &report) {
    const char *samplers[] = {"grid", "sobol", "mis"};
    describe(image, "reference", scene);
    auto &attributes = image.attributes;
    attributes["slopemix.brdf"] = brdf.name();
    attributes["slopemix.brdf_sha256"] = brdf.sha256();
    attributes["slopemix.sampler"] = samplers[static_cast<int>(options.sampler)];
    attributes["slopemix.spp"] = std::to_string(options.target_error > 0.0 ? report.spp : options.spp);
    attributes["slopemix.grade"] = grade_name(options.grade);
    attributes["slopemix.seed"] = std::to_string(options.seed);
    attributes["slopemix.lookup"] = options.lookup == Lookup::Nearest ? "nearest" : "linear";
    if (report.standard_error >= 0.0) attributes["slopemix.standard_error"] = number_text(report.standard_error);
}

} // namespace

Rendered integrate_reference(Context &context, const Brdf &brdf, const ProposalSource &source, const Scene &scene,
                             const RenderOptions &options) {
    validate(scene);
    validate(options);
    validate(options.grade, context);
    const Context::Lock lock(context);
    const CallTimer timer(context);
    Rendered result{Image(scene.width, scene.height), {}};
    report_progress(options, 0.0);
    const std::vector<Lobe> proposal = draws_about_wh(scene, options) ? source() : std::vector<Lobe>{};

    constexpr std::uint32_t first_try = 64;
    const bool to_target = options.target_error > 0.0;
    double kernel_seconds = 0.0;
    std::uint64_t evaluations = 0;
    for (std::uint32_t spp = to_target ? first_try : options.spp;;) {
        result.report = integrate_image(context, brdf, proposal, scene, options, spp, result.image);
        kernel_seconds += result.report.kernel_seconds;
        evaluations += result.report.evaluations;
        if (std::isnan(result.report.standard_error))
            fail(Fault::Internal, "the reference's standard error is no number");
        if (!to_target || result.report.standard_error <= options.target_error || spp >= max_spp) break;
        spp = next_spp(spp, result.report.standard_error, options.target_error);
    }
    describe_reference(result.image, brdf, scene, options, result.report);
    const RenderReport times = timer.finish(context, kernel_seconds, evaluations);
    result.report.seconds = times.seconds;
    result.report.build_seconds = times.build_seconds;
    result.report.kernel_seconds = times.kernel_seconds;
    result.report.evaluations = times.evaluations;
    return result;
}

} // namespace smx
