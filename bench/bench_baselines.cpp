// What the reference is compared with (baselines/reference.h): nanoseconds per sample. Their mean is checked against
// the reference's first.
#include <cmath>

#include "bench.h"
#include "reference.h"

namespace {

struct Wanted {
    double mean_green, evaluations; // evaluations: of plain_samples per pixel
};

Wanted reference() {
    const smx_scene scene = reference_scene();
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.spp = 1024;
    smx_image image = nullptr;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    check(smx_render_reference(shared_context(), two_layer(), &scene, &options, &image, &report));
    constexpr int pixels = reference_side * reference_side;
    double sum = 0.0;
    for (int k = 0; k < pixels; ++k) sum += static_cast<double>(smx_image_pixels(image)[4 * k + 1]);
    smx_image_release(image);
    return {sum / pixels, static_cast<double>(report.evaluations) / report.spp * plain_samples};
}

template <typename Integrate>
void measure(benchmark::State &state, Integrate integrate) {
    const Wanted wanted = reference();
    std::uint32_t seed = 1;
    if (!(std::abs(integrate(seed).mean_green / wanted.mean_green - 1.0) < 0.05)) {
        state.SkipWithError("the baseline's image is another one");
        return;
    }
    for (auto _ : state) state.SetIterationTime(integrate(++seed).seconds);
    state.counters["s/eval"] = benchmark::Counter(
        wanted.evaluations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

std::vector<float> table() {
    std::vector<float> nodes;
    check(plain_table(two_layer(), &nodes));
    return nodes;
}

void plain_kernel(benchmark::State &state) {
    smx_device_info device = SMX_DEVICE_INFO_INIT;
    check(smx_context_get_info(shared_context(), &device));
    ReferencePlain plain(device.index, table());
    measure(state, [&](std::uint32_t seed) { return plain.integrate(seed); });
}
BENCHMARK(plain_kernel)->Name("reference.plain-kernel")->UseManualTime();

void scalar(benchmark::State &state) {
    const std::vector<float> nodes = table();
    measure(state, [&](std::uint32_t seed) { return reference_scalar(nodes, seed); });
}
BENCHMARK(scalar)->Name("reference.scalar-one-core")->UseManualTime();

} // namespace
