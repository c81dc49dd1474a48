#include "integrate_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "direction_pairs.h"
#include "error.h"
#include "facet_integral.h"
#include "integrate_uniform.h"
#include "reference_attributes.h"
#include "sample_to_target.h"
#include "table_slice.h"
#include "table_whole.h"

namespace smx {

namespace {

struct PlannedAttempt {
    double kernel_seconds, standard_error;
};

// Tries with the plans that the options' sampler has.
RenderReport integrate_to_target(const RenderOptions &options, IntegralTask &task, std::uint64_t lit,
                                 const std::function<PlannedAttempt(std::uint32_t spp)> &attempt) {
    return sample_to_target(options, lit, [&](std::uint32_t spp) -> Attempt {
        task.plan = sampling_plan(task.displacement, options.sampler, spp, options.scrambles);
        const PlannedAttempt tried = attempt(spp);
        return {task.plan.samples(), tried.kernel_seconds, task.plan.scrambles > 1 ? tried.standard_error : -1.0};
    });
}

bool draws_about_wh(const Displacement &displacement, const RenderOptions &options) {
    return sampling_plan(displacement, options.sampler, options.spp, options.scrambles).passes.size() > 1;
}

// A reference leaves out only what it is told to: auto is all.
Effects reference_effects_of(const RenderOptions &options, Masking masking) {
    return requested_effects(options.effects, reference_effects, "the reference", masking);
}

IntegralTask task_of(const Displacement &displacement, Effects on, const RenderOptions &options) {
    IntegralTask task;
    task.displacement = displacement;
    task.effects = on;
    task.lookup = options.lookup;
    task.seed = options.seed;
    task.grade = options.grade;
    task.tiling = options.tiling;
    return task;
}

void set_call_times(RenderReport &report, const RenderReport &times) {
    report.seconds = times.seconds;
    report.build_seconds = times.build_seconds;
}

PairPlanes planes_of(const float *wi, const float *wo, std::size_t count, std::size_t lanes) {
    const std::size_t stride = count + lanes;
    return {stride, padded_planes(wi, count, stride), padded_planes(wo, count, stride)};
}

// Pairs with both directions above the surface.
std::uint64_t lit_pairs(const float *wi, const float *wo, std::size_t count) {
    std::uint64_t lit = 0;
    for (std::size_t k = 2 * count; k < 3 * count; ++k) lit += wi[k] > 0.0f && wo[k] > 0.0f;
    return lit;
}

// Three of every four values into planes.
void scatter(const std::vector<float> &rgba, const Tile &tile, std::size_t count, float *planes) {
    for (std::size_t k = 0; k < tile.rows; ++k)
        for (std::size_t c = 0; c < 3; ++c) planes[c * count + tile.first_row + k] = rgba[4 * k + c];
}

PlannedAttempt try_pairs(Context &context, const IntegralTask &task, const RenderOptions &options, std::size_t count,
                         float *fcos, float *errors) {
    RowErrors seen(count);
    TileJob job;
    job.tiles = tiles_of(static_cast<std::uint32_t>(count), 1, context.device_count(), options.tiling);
    job.start = [&](Context &device) -> TileWork {
        struct Own {
            FacetIntegral integral;
            std::vector<float> rgba, errors;
        };
        const std::size_t most = 4 * std::size_t{most_rows(job.tiles)};
        const auto own = std::make_shared<Own>(
            Own{FacetIntegral(device, task, most_rows(job.tiles)), std::vector<float>(most), std::vector<float>(most)});
        return [own, &seen, count, fcos, errors](const Tile &tile, const Step &step) {
            const double seconds = own->integral.integrate(tile, {own->rgba.data(), own->errors.data()}, seen, step);
            scatter(own->rgba, tile, count, fcos);
            if (errors) scatter(own->errors, tile, count, errors);
            return seconds;
        };
    };
    job.take = [](const Tile &) {};
    job.progress = options.progress;
    job.ahead = job.tiles.size();
    const double seconds = run_tiles(context, job);
    return {seconds, seen.relative()};
}

// Of a task without pairs yet; arrays are planes.
RenderReport integrate_list(Context &context, const RenderOptions &options, IntegralTask &task, std::size_t count,
                            const float *wi, const float *wo, float *fcos, float *errors) {
    const PairPlanes pairs = planes_of(wi, wo, count, context.width());
    task.pairs = &pairs;
    task.row_items = 1;

    // Into arrays of ours first: what fails leaves the caller's as they were.
    std::vector<float> values(3 * count), deviations(errors ? 3 * count : 0);
    const RenderReport report = integrate_to_target(options, task, lit_pairs(wi, wo, count), [&](std::uint32_t) {
        return try_pairs(context, task, options, count, values.data(), errors ? deviations.data() : nullptr);
    });
    std::copy(values.begin(), values.end(), fcos);
    std::copy(deviations.begin(), deviations.end(), errors);
    return report;
}

} // namespace

Rendered integrate_reference(Context &context, const Brdf &brdf, const ProposalSource &source, const Scene &scene,
                             const RenderOptions &options) {
    if (scene.light == Light::Uniform) return integrate_uniform(context, brdf, source, scene, options);
    validate(scene);
    validate(options);
    validate(options.grade, context);
    const Effects on = reference_effects_of(options, scene.masking);
    const Displacement displacement = simplified(scene.displacement, on);
    const Context::Lock lock(context);
    const CallTimer timer(context);
    const auto canvas = make_canvas(scene.width, scene.height, options.errors, options.exr_path);
    report_progress(options, 0.0);

    const bool about_wh = draws_about_wh(displacement, options);
    const std::vector<Lobe> proposal = about_wh ? source(theta_d(scene)) : std::vector<Lobe>{};
    const std::vector<float> table =
        options.whole_table ? table_whole(brdf) : table_slice(brdf, theta_d(scene), options.lookup);
    IntegralTask task = task_of(displacement, on, options);
    task.scene = &scene;
    task.row_items = scene.width;
    task.whole_table = options.whole_table;
    task.table = &table;
    task.proposal = &proposal;

    Attributes attributes;
    RenderReport report =
        integrate_to_target(options, task, lit_pixels(scene), [&](std::uint32_t spp) -> PlannedAttempt {
            RowErrors seen(scene.height);
            attributes = describe_reference(brdf, scene, options, on, spp);
            canvas->begin(attributes);
            const auto start = [&](Context &device, std::uint32_t most_rows) -> RenderRows {
                const auto integral = std::make_shared<FacetIntegral>(device, task, most_rows);
                return [integral, &seen](const Tile &tile, const TileRows &to, const Step &step) {
                    return integral->integrate(tile, to, seen, step);
                };
            };
            const double seconds = render_tiles(context, scene, options, *canvas, start);
            return {seconds, seen.relative()};
        });
    if (report.standard_error >= 0.0) attributes["slopemix.standard_error"] = number_text(report.standard_error);
    std::optional<Image> image = canvas->finish(attributes);
    set_call_times(report, timer.finish(context, 0.0, 0));
    report.effects = on;
    return {std::move(image), report};
}

RenderReport integrate_pairs(Context &context, const Brdf &brdf, const ProposalSource &source, const Displacement &x,
                             Masking masking, const RenderOptions &options, std::size_t count, const float *wi,
                             const float *wo, float *fcos, float *errors) {
    validate(x);
    validate(masking);
    validate(options);
    validate(options.grade, context);
    require(options.exr_path.empty(), "exr_path is \"", options.exr_path, "\"; pairs of directions make no image");
    require_pair_count(count);
    const Effects on = reference_effects_of(options, masking);
    const Displacement displacement = simplified(x, on);
    const Context::Lock lock(context);
    const CallTimer timer(context);
    report_progress(options, 0.0);
    if (count == 0) return timer.finish(context, 0.0, 0);

    const bool about_wh = draws_about_wh(displacement, options);
    const std::vector<Lobe> proposal = about_wh ? source(std::nullopt) : std::vector<Lobe>{};
    const std::vector<float> table = table_whole(brdf);
    IntegralTask task = task_of(displacement, on, options);
    task.whole_table = true;
    task.table = &table;
    task.proposal = &proposal;
    RenderReport report = integrate_list(context, options, task, count, wi, wo, fcos, errors);
    set_call_times(report, timer.finish(context, 0.0, 0));
    report.effects = on;
    return report;
}

RenderReport integrate_pixels(Context &context, const Brdf &brdf, const ProposalSource &source, const Scene &scene,
                              const RenderOptions &options, std::size_t count, const float *wi, const float *wo,
                              float *fcos, float *errors) {
    validate(options);
    const Effects on = reference_effects_of(options, scene.masking);
    const Displacement displacement = simplified(scene.displacement, on);
    const Context::Lock lock(context);
    const CallTimer timer(context);
    report_progress(options, 0.0);

    const bool about_wh = draws_about_wh(displacement, options);
    const std::vector<Lobe> proposal = about_wh ? source(theta_d(scene)) : std::vector<Lobe>{};
    const std::vector<float> table = table_slice(brdf, theta_d(scene), options.lookup);
    IntegralTask task = task_of(displacement, on, options);
    task.table = &table;
    task.proposal = &proposal;
    RenderReport report = integrate_list(context, options, task, count, wi, wo, fcos, errors);
    set_call_times(report, timer.finish(context, 0.0, 0));
    report.effects = on;
    return report;
}

} // namespace smx
