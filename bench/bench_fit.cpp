// Time of the fit's stages on the built-in material.
#include "bench.h"

namespace {

void invert(benchmark::State &state) {
    smx_brdf brdf = two_layer(); // made before the clock runs
    for (auto _ : state) {
        smx_density density = nullptr;
        check(smx_density_create(brdf, nullptr, &density));
        smx_density_release(density);
    }
}
BENCHMARK(invert)->Name("fit.inversion")->Unit(benchmark::kMillisecond);

void fit(benchmark::State &state, smx_model model) {
    smx_density density = nullptr;
    check(smx_density_create(two_layer(), nullptr, &density));
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.model = model;
    options.lobes = static_cast<uint32_t>(state.range(0));
    for (auto _ : state) {
        smx_material material = nullptr;
        check(smx_material_fit(density, &options, &material));
        smx_material_release(material);
    }
    smx_density_release(density);
}
BENCHMARK_CAPTURE(fit, shared, SMX_MODEL_SHARED)
    ->Name("fit.shared")
    ->ArgName("n")
    ->Arg(1)
    ->Arg(8)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, per_lobe, SMX_MODEL_PER_LOBE)
    ->Name("fit.per-lobe")
    ->ArgName("n")
    ->Arg(1)
    ->Arg(8)
    ->Unit(benchmark::kMillisecond);

} // namespace
