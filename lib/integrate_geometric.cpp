#include "integrate_geometric.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "error.h"
#include "geometric_integral.h"
#include "sampling_plan.h"
#include "table_whole.h"

namespace smx {

namespace {

void validate(const RenderOptions &o, const GeometricOptions &g) {
    require(o.lookup == Lookup::Linear || o.lookup == Lookup::Nearest, "lookup is ", static_cast<int>(o.lookup),
            "; it must be 0 or 1");
    require(o.target_error == 0.0, "target_error is ", o.target_error, "; the geometric reference takes only 0");
    require(std::has_single_bit(g.tile) && g.tile >= min_tile && g.tile <= max_tile, "tile is ", g.tile,
            "; it must be a power of two, ", min_tile, "..", max_tile);
    require(g.realisations >= 1 && g.realisations <= max_realisations, "realisations is ", g.realisations,
            "; it must be 1..", max_realisations);
    require(g.bounces <= max_bounces, "bounces is ", g.bounces, "; it must be 0..", max_bounces);
    require(o.spp >= 1 && o.spp <= max_spp, "spp is ", o.spp, "; it must be 1..", max_spp);
    require(o.spp % g.realisations == 0, "spp is ", o.spp, "; it must be a multiple of realisations, ", g.realisations);
    require(!o.errors || g.realisations > 1, "errors need at least 2 realisations: one has no estimate of its error");
}

std::uint64_t largest_buffer(std::uint64_t side) { return side * side / 3 * 4 * sizeof(float); } // maxima
std::uint64_t tile_bytes(std::uint64_t side) { return largest_buffer(side) + side * side * sizeof(float); }

// Counts the one tile that a device holds at a time, heights and maxima. The other half of its memory is left to what
// is not counted: table and pixels, and, where the device is the host, two fields as they are drawn, with their maxima.
void require_room(Context &context, std::uint32_t tile) {
    for (const Context *device : context.devices()) {
        const auto cl_device = device->queue().getInfo<CL_QUEUE_DEVICE>();
        const std::uint64_t one = cl_device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(),
                            all = cl_device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>() / 2;
        std::uint32_t fits = max_tile;
        while (largest_buffer(fits) > one || tile_bytes(fits) > all) fits /= 2;
        require(tile <= fits, "tile is ", tile, "; it must be at most ", fits, " in the memory of ",
                device->info().name, " (", all * 2 >> 20, " MiB, ", one >> 20, " MiB at a time)");
    }
}

Attributes describe_geometric(const Brdf &brdf, const Scene &scene, const RenderOptions &o, const GeometricOptions &g) {
    Attributes attributes = describe("geometric", scene);
    attributes.erase("slopemix.g"); // there is no formula for masking
    attributes["slopemix.brdf"] = brdf.name();
    attributes["slopemix.brdf_sha256"] = brdf.sha256();
    attributes["slopemix.spp"] = std::to_string(o.spp);
    attributes["slopemix.seed"] = std::to_string(o.seed);
    attributes["slopemix.lookup"] = o.lookup == Lookup::Nearest ? "nearest" : "linear";
    attributes["slopemix.tile"] = std::to_string(g.tile);
    attributes["slopemix.realisations"] = std::to_string(g.realisations);
    attributes["slopemix.bounces"] = std::to_string(g.bounces);
    return attributes;
}

// Of auto and all, interreflection is on where paths go on at all.
Effects geometric_effects_of(const RenderOptions &options, std::uint32_t bounces) {
    const Effects on =
        requested_effects(options.effects, geometric_effects, "the geometric reference", Masking::Correlated);
    const bool named = options.effects != auto_effects && options.effects != all_effects;
    require(!named || bounces > 0 || !(on & interreflection_effect),
            "effects has interreflection, and bounces is 0; it must be 1..", max_bounces);
    return bounces > 0 ? on : on & ~static_cast<Effects>(interreflection_effect);
}

struct Interreflection {
    double share = -1.0; // of the image, relRMSE; negative: not judged
    RenderReport cost;   // times only
};

// What interreflection adds to the image, by a pilot: the scene in little, with it and without. Both follow the same
// paths as far as both go; what is left of their noise counts as if it were light.
Interreflection judge_interreflection(Context &context, const Brdf &brdf, const ProposalSource &source,
                                      const Scene &scene, const RenderOptions &options,
                                      const GeometricOptions &geometric) {
    constexpr std::uint32_t side = 32, tile = 256, realisations = 2, samples = 128;
    const double scale = std::min(1.0, double{side} / std::min(scene.width, scene.height));
    Scene little = scene;
    little.width = static_cast<std::uint32_t>(std::ceil(scale * scene.width));
    little.height = static_cast<std::uint32_t>(std::ceil(scale * scene.height));
    RenderOptions pilot = options;
    pilot.spp = realisations * samples;
    pilot.errors = false;
    pilot.exr_path.clear();
    if (options.progress) pilot.progress = [&](double) { return options.progress(0.0); }; // by which it is stopped
    const GeometricOptions of_pilot = {std::min(geometric.tile, tile), realisations, geometric.bounces};
    pilot.effects = geometric_effects;
    const Rendered with = integrate_geometric(context, brdf, source, little, pilot, of_pilot);
    pilot.effects &= ~static_cast<Effects>(interreflection_effect);
    const Rendered without = integrate_geometric(context, brdf, source, little, pilot, of_pilot);
    Interreflection judged = {compare(*without.image, *with.image).relrmse, with.report};
    add_times(judged.cost, without.report);
    return judged;
}

} // namespace

Rendered integrate_geometric(Context &context, const Brdf &brdf, const ProposalSource &source, const Scene &scene,
                             const RenderOptions &options, const GeometricOptions &asked) {
    validate(scene);
    validate(options, asked);
    Effects on = geometric_effects_of(options, asked.bounces);
    Interreflection interreflection;
    if (options.effects == auto_effects && (on & interreflection_effect)) {
        interreflection = judge_interreflection(context, brdf, source, scene, options, asked);
        if (interreflection.share <= options.effect_tolerance) on &= ~static_cast<Effects>(interreflection_effect);
    }
    GeometricOptions geometric = asked;
    if (!(on & interreflection_effect)) geometric.bounces = 0;
    Scene simple = scene;
    simple.displacement = simplified(scene.displacement, on);
    require_room(context, geometric.tile);
    const Context::Lock lock(context);
    const CallTimer timer(context);
    const auto canvas = make_canvas(scene.width, scene.height, options.errors, options.exr_path);
    report_progress(options, 0.0);

    const std::vector<float> table = table_whole(brdf);
    HeightFields fields(static_cast<std::uint32_t>(std::countr_zero(geometric.tile)), options.seed);
    GeometricTask task;
    task.scene = &simple;
    task.effects = on;
    task.options = geometric;
    task.lookup = options.lookup;
    task.samples = options.spp / geometric.realisations;
    task.seed = options.seed;
    task.table = &table;
    task.fields = &fields;
    task.tiling = options.tiling;
    const std::vector<Lobe> proposal = task.has_paths() ? source(std::nullopt) : std::vector<Lobe>{};
    task.proposal = &proposal;

    RowErrors seen(scene.height);
    Attributes attributes = describe_geometric(brdf, scene, options, geometric);
    attributes["slopemix.effects"] = effects_text(on);
    if (interreflection.share >= 0.0) attributes["slopemix.interreflection"] = number_text(interreflection.share);
    canvas->begin(attributes);
    const auto start = [&](Context &device, std::uint32_t most_rows) -> RenderRows {
        const auto integral = std::make_shared<GeometricIntegral>(device, task, most_rows);
        return [integral, &seen](const Tile &tile, const TileRows &to, const Step &step) {
            return integral->integrate(tile, to, seen, step);
        };
    };
    const double seconds = render_tiles(context, scene, options, *canvas, start);
    const double standard_error = geometric.realisations > 1 ? seen.relative() : -1.0;
    if (std::isnan(standard_error)) fail(Fault::Internal, "the geometric reference's standard error is no number");
    if (standard_error >= 0.0) attributes["slopemix.standard_error"] = number_text(standard_error);
    std::optional<Image> image = canvas->finish(attributes);
    const std::uint64_t lit = scene.light == Light::Uniform ? sphere_pixels(scene) : lit_pixels(scene);
    RenderReport report = timer.finish(context, seconds, lit * options.spp);
    report.spp = options.spp;
    report.effects = on;
    report.interreflection = interreflection.share;
    add_times(report, interreflection.cost);
    report.standard_error = standard_error;
    return {std::move(image), report};
}

} // namespace smx
