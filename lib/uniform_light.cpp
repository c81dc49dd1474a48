#include "uniform_light.h"

#include <algorithm>
#include <memory>

#include "device_buffer.h"
#include "device_estimate.h"
#include "error.h"
#include "sample_to_target.h"
#include "sampling_parts.h"

namespace smx {

namespace {

// A sample takes many times as long as one of the reference's under a directional light. So launches are shorter,
// and tiles smaller, that progress is told and a cancel heard as often.
constexpr std::uint32_t part_evaluations = 1u << 20, tile_pixels = 1u << 12;

Tiling tiling_of(const Scene &scene, const RenderOptions &options) {
    Tiling tiling = options.tiling;
    if (tiling.rows == 0) tiling.rows = std::max(tile_pixels / scene.width, 1u);
    return tiling;
}

std::vector<Part> parts_of(const UniformTask &task, std::size_t pixels) {
    const auto most = static_cast<std::uint32_t>(std::max<std::size_t>(part_evaluations / pixels, 1));
    return sampling_parts(task.plan, pixels, 1, task.tiling.facets ? task.tiling.facets : most);
}

std::vector<cl_uint> seeds_of(const UniformTask &task) {
    std::vector<cl_uint> seeds;
    for (std::uint32_t s = 0; s < task.plan.scrambles; ++s) seeds.push_back(pass_seed(task.seed, s, 0));
    return seeds;
}

} // namespace

UniformIntegral::UniformIntegral(Context &device, const UniformTask &task, std::uint32_t most_rows, UniformKernel own)
    : device_(device), task_(task), own_(std::move(own)) {
    const std::size_t pixels = std::size_t{most_rows} * task.scene.width;
    rgba_ = empty_buffer<cl_float4>(device, pixels);
    errors_ = empty_buffer<cl_float4>(device, pixels);
    estimates_ = empty_buffer<DeviceEstimate>(device, pixels);
    seeds_ = buffer_from(device, seeds_of(task));
    own_.kernel.setArg(0, rgba_);
    own_.kernel.setArg(1, errors_);
    own_.kernel.setArg(2, estimates_);
    own_.kernel.setArg(4, seeds_);
    set_arg(own_.kernel, 6, task.scene, task.grade);
    set_arg(own_.kernel, 7, task.scene.displacement, task.grade);
}

double UniformIntegral::integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step) {
    const std::size_t width = task_.scene.width, lanes = device_.width(), pixels = tile.rows * width;
    double seconds = 0.0, done = 0.0;
    own_.kernel.setArg(5, static_cast<cl_int>(tile.first_row));
    for (const Part &part : parts_of(task_, pixels)) {
        own_.kernel.setArg(3, part);
        // A work-item of several pixels has work enough to be a group of its own.
        const std::uint32_t group = task_.tiling.work_group || lanes == 1 ? task_.tiling.work_group : 1;
        seconds += launch(device_, own_.kernel, round_up(width, lanes) / lanes, tile.rows, group);
        done += static_cast<double>(part.scrambles) * part.size;
        step(std::min(done / task_.plan.samples(), 1.0));
    }
    unkept_errors_.resize(to.errors ? 0 : 4 * pixels);
    float *errors = to.errors ? to.errors : unkept_errors_.data();
    read_rows(device_, rgba_, pixels, to.rgba);
    read_rows(device_, errors_, pixels, errors);
    for (std::size_t row = 0; row < tile.rows; ++row)
        seen.set(tile.first_row + row, to.rgba + 4 * row * width, errors + 4 * row * width, width);
    return seconds;
}

void validate_uniform(const RenderOptions &options) {
    validate(options);
    require(options.sampler != Sampler::Grid,
            "sampler is 0 (grid); under a uniform light it must be 1 (sobol) or 2 (mis)");
}

Rendered render_uniform(Context &context, const Scene &scene, const Displacement &simulated, const RenderOptions &given,
                        const UniformImage &image) {
    const Context::Lock lock(context);
    const CallTimer timer(context);
    RenderOptions options = given;
    options.tiling = tiling_of(scene, given);
    const auto canvas = make_canvas(scene.width, scene.height, options.errors, options.exr_path);
    report_progress(options, 0.0);

    UniformTask task = {scene, {}, options.seed, options.grade, options.tiling};
    task.scene.displacement = simulated;
    Attributes attributes;
    RenderReport report = sample_to_target(options, sphere_pixels(scene), [&](std::uint32_t spp) -> Attempt {
        task.plan = uniform_plan(spp, options.scrambles);
        RowErrors seen(scene.height);
        attributes = image.describe(spp);
        canvas->begin(attributes);
        const double seconds =
            render_tiles(context, scene, options, *canvas, [&](Context &device, std::uint32_t most_rows) -> RenderRows {
                const UniformKernel own = image.start(device);
                const auto integral = std::make_shared<UniformIntegral>(device, task, most_rows, own);
                return [&, own, integral](const Tile &tile, const TileRows &to, const Step &step) {
                    return integral->integrate(tile, to, seen, [&](double share) {
                        if (image.finish_part) image.finish_part(device, own);
                        step(share);
                    });
                };
            });
        return {task.plan.samples(), seconds, task.plan.scrambles > 1 ? seen.relative() : -1.0};
    });
    if (report.standard_error >= 0.0) attributes["slopemix.standard_error"] = number_text(report.standard_error);
    std::optional<Image> finished = canvas->finish(attributes);
    const RenderReport times = timer.finish(context, 0.0, 0);
    report.seconds = times.seconds;
    report.build_seconds = times.build_seconds;
    return {std::move(finished), report};
}

} // namespace smx
