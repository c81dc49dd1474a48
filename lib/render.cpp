#include "render.h"

#include <array>
#include <charconv>
#include <chrono>
#include <utility>

#include "error.h"

namespace smx {

double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string sampler_name(Sampler sampler) {
    constexpr const char *names[] = {"grid", "sobol", "mis"};
    return names[static_cast<int>(sampler)];
}

double render_tiles(Context &context, const Scene &scene, const RenderOptions &options, Canvas &canvas,
                    const StartRows &start) {
    TileJob job;
    job.tiles = tiles_of(scene.height, scene.width, context.device_count(), options.tiling);
    job.start = [&](Context &device) -> TileWork {
        return [&canvas, render = start(device, most_rows(job.tiles))](const Tile &tile, const Step &step) {
            return render(tile, canvas.rows(tile), step);
        };
    };
    job.take = [&](const Tile &tile) { canvas.take(tile); };
    job.progress = options.progress;
    job.ahead = canvas.ahead(context.device_count());
    return run_tiles(context, job);
}

Rendered render_once(Context &context, const Scene &scene, const RenderOptions &options, const Attributes &attributes,
                     const StartRows &start) {
    const Context::Lock lock(context);
    const CallTimer timer(context);
    const auto canvas = make_canvas(scene.width, scene.height, false, options.exr_path);
    report_progress(options, 0.0);
    canvas->begin(attributes);
    const double kernel_seconds = render_tiles(context, scene, options, *canvas, start);
    std::optional<Image> image = canvas->finish(attributes);
    return {std::move(image), timer.finish(context, kernel_seconds, sphere_pixels(scene))};
}

void read_rows(const Context &device, const cl::Buffer &from, std::size_t pixels, float *to) {
    device.queue().enqueueReadBuffer(from, CL_TRUE, 0, pixels * sizeof(cl_float4), to);
}

void report_progress(const RenderOptions &options, double share) {
    if (options.progress && options.progress(share)) fail(Fault::Cancelled, "cancelled by the progress callback");
}

void add_times(RenderReport &report, const RenderReport &times) {
    report.seconds += times.seconds;
    report.kernel_seconds += times.kernel_seconds;
    report.build_seconds += times.build_seconds;
}

CallTimer::CallTimer(const Context &context) : start_(now_seconds()), build_seconds_(context.build_seconds()) {}

RenderReport CallTimer::finish(const Context &context, double kernel_seconds, std::uint64_t evaluations) const {
    RenderReport report;
    report.seconds = now_seconds() - start_;
    report.kernel_seconds = kernel_seconds;
    report.build_seconds = context.build_seconds() - build_seconds_;
    report.evaluations = evaluations;
    return report;
}

std::string number_text(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

Attributes describe(const std::string &integrator, const Scene &s) {
    Attributes a;
    a["slopemix.version"] = SMX_LIBRARY_VERSION;
    a["slopemix.integrator"] = integrator;
    if (s.light == Light::Uniform)
        a["slopemix.light"] = "uniform";
    else
        a["slopemix.light_phi"] = number_text(s.light_phi);
    a["slopemix.alpha_x"] = number_text(s.displacement.alpha_x);
    a["slopemix.alpha_y"] = number_text(s.displacement.alpha_y);
    a["slopemix.rho"] = number_text(s.displacement.rho);
    a["slopemix.mean_slope_x"] = number_text(s.displacement.mean_slope_x);
    a["slopemix.mean_slope_y"] = number_text(s.displacement.mean_slope_y);
    a["slopemix.g"] = s.masking == Masking::Separable ? "separable" : "correlated";
    return a;
}

} // namespace smx
