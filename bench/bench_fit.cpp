// Time of the fit's stages on the built-in material.
#include "bench.h"

namespace {

void invert(benchmark::State &state) {
    for (auto _ : state) {
        smx_density density = nullptr;
        check(smx_density_create(two_layer(), nullptr, &density));
        smx_density_release(density);
    }
}
BENCHMARK(invert)->Name("fit.inversion")->Unit(benchmark::kMillisecond);

void fit_mixture(benchmark::State &state) {
    smx_density density = nullptr;
    check(smx_density_create(two_layer(), nullptr, &density));
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.lobes = static_cast<uint32_t>(state.range(0));
    for (auto _ : state) {
        smx_material material = nullptr;
        check(smx_material_fit(density, &options, &material));
        smx_material_release(material);
    }
    smx_density_release(density);
}
BENCHMARK(fit_mixture)->Name("fit.mixture")->ArgName("n")->Arg(1)->Arg(2)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
