// Nanoseconds per sample of the reference on the whole device, from OpenCL's events, not of the call.
#include <cmath>
#include <random>
#include <vector>

#include "bench.h"

namespace {

smx_scene bench_scene(uint32_t side) {
    smx_scene scene = SMX_SCENE_INIT;
    scene.width = scene.height = side;
    scene.displacement = {0.25, 0.25, 0.0, 0.0, 0.0};
    return scene;
}

// Runs `render` until the benchmark has enough, with the kernel's seconds per evaluation as its time.
template <typename Render>
void measure(benchmark::State &state, Render render) {
    smx_image warm_up = nullptr;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    check(render(&warm_up, &report));
    smx_image_release(warm_up);
    for (auto _ : state) {
        smx_image image = nullptr;
        check(render(&image, &report));
        smx_image_release(image);
        state.SetIterationTime(report.kernel_seconds);
    }
    const double evaluations = static_cast<double>(report.evaluations);
    state.counters["s/eval"] =
        benchmark::Counter(evaluations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

smx_render_options reference_options(smx_sampler sampler) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.sampler = sampler;
    options.spp = 4096;
    return options;
}

void reference(benchmark::State &state, smx_sampler sampler, int whole_table) {
    const smx_scene scene = bench_scene(128);
    smx_render_options options = reference_options(sampler);
    options.whole_table = whole_table;
    measure(state, [&](smx_image *image, smx_render_report *report) {
        return smx_render_reference(shared_context(), two_layer(), &scene, &options, image, report);
    });
}
BENCHMARK_CAPTURE(reference, grid, SMX_SAMPLER_GRID, 0)->Name("reference.slice.grid")->UseManualTime();
BENCHMARK_CAPTURE(reference, sobol, SMX_SAMPLER_SOBOL, 0)->Name("reference.slice.sobol")->UseManualTime();
BENCHMARK_CAPTURE(reference, mis, SMX_SAMPLER_MIS, 0)->Name("reference.slice.mis")->UseManualTime();
BENCHMARK_CAPTURE(reference, grid, SMX_SAMPLER_GRID, 1)->Name("reference.full.grid")->UseManualTime();
BENCHMARK_CAPTURE(reference, mis, SMX_SAMPLER_MIS, 1)->Name("reference.full.mis")->UseManualTime();

// Primary ray, shadow ray and lookup, on a tile of 1024 x 1024; paths go on to a second facet.
void geometric(benchmark::State &state, uint32_t bounces) {
    const smx_scene scene = bench_scene(128);
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.spp = 256;
    smx_geometric_options how = SMX_GEOMETRIC_OPTIONS_INIT;
    how.realisations = 2;
    how.bounces = bounces;
    measure(state, [&](smx_image *image, smx_render_report *report) {
        return smx_render_geometric(shared_context(), two_layer(), &scene, &options, &how, image, report);
    });
}
BENCHMARK_CAPTURE(geometric, single, 0)->Name("geometric.path")->UseManualTime();
BENCHMARK_CAPTURE(geometric, bounce, 1)->Name("geometric.bounce")->UseManualTime();

// Pairs of directions, all with another theta_d.
void reference_pairs(benchmark::State &state, smx_sampler sampler) {
    constexpr size_t count = 4096;
    const smx_displacement x = {0.25, 0.25, 0.0, 0.0, 0.0};
    const smx_render_options options = reference_options(sampler);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> cosine(0.1f, 1.0f), azimuth(0.0f, 6.2831853f);
    std::vector<float> wi(3 * count), wo(3 * count), fcos(3 * count);
    for (std::vector<float> *w : {&wi, &wo})
        for (size_t k = 0; k < count; ++k) {
            const float z = cosine(random), phi = azimuth(random), sine = std::sqrt(1.0f - z * z);
            (*w)[k] = sine * std::cos(phi);
            (*w)[count + k] = sine * std::sin(phi);
            (*w)[2 * count + k] = z;
        }
    measure(state, [&](smx_image *, smx_render_report *report) {
        return smx_brdf_integrate(shared_context(), two_layer(), &x, SMX_G2_CORRELATED, &options, count, wi.data(),
                                  wo.data(), fcos.data(), nullptr, report);
    });
}
BENCHMARK_CAPTURE(reference_pairs, grid, SMX_SAMPLER_GRID)->Name("reference.pairs.grid")->UseManualTime();
BENCHMARK_CAPTURE(reference_pairs, mis, SMX_SAMPLER_MIS)->Name("reference.pairs.mis")->UseManualTime();

} // namespace
