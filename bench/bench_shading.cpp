// Filtered shading: nanoseconds per evaluation on the whole device by model, number of lobes and grade, from OpenCL's
// events, the least of the iterations beside the mean; how many times less than the baselines (shading.h), of the same
// run. The baselines' pictures are checked against the library's first.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bench.h"
#include "shading.h"

namespace {

// Renders and returns the report; the picture, if asked for.
smx_render_report render(smx_material material, smx_grade grade, std::vector<float> *rgba = nullptr) {
    const smx_scene scene = shading_scene();
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.grade = grade;
    smx_image image = nullptr;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    check(smx_render_filtered(shared_context(), material, &scene, &options, &image, &report));
    const float *pixels = smx_image_pixels(image);
    if (rgba) rgba->assign(pixels, pixels + 4 * shading_side * shading_side);
    smx_image_release(image);
    return report;
}

// Root mean square of a - b over that of b.
double difference(const std::vector<float> &a, const std::vector<float> &b) {
    double error2 = 0.0, value2 = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        error2 += std::pow(double{a[k]} - double{b[k]}, 2);
        value2 += std::pow(double{b[k]}, 2);
    }
    return std::sqrt(error2 / value2);
}

// The least seconds of a few runs, or a negative number where the picture is not `wanted`.
double baseline_seconds(ShadingResult (*shade)(const ShadingCase &), const ShadingCase &what,
                        const std::vector<float> &wanted) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 3; ++run) {
        const ShadingResult result = shade(what);
        if (!(difference(result.rgba, wanted) < 1e-3)) return -1.0;
        least = std::min(least, result.seconds);
    }
    return least;
}

ShadingResult shade_builtin(const ShadingCase &what) {
    static ShadingBuiltin builtin = [] {
        smx_device_info device = SMX_DEVICE_INFO_INIT;
        check(smx_context_get_info(shared_context(), &device));
        return ShadingBuiltin(device.index);
    }();
    return builtin.shade(what);
}

struct Baselines {
    double scalar, builtin; // seconds
};

// Measured once for a model and number of lobes.
const Baselines &baselines(const ShadingCase &what, const std::vector<float> &wanted) {
    static std::map<std::pair<bool, std::size_t>, Baselines> measured;
    const auto [at, is_new] = measured.try_emplace({what.per_lobe, what.lobes.size()});
    if (is_new)
        at->second = {baseline_seconds(shade_scalar, what, wanted), baseline_seconds(shade_builtin, what, wanted)};
    return at->second;
}

void shade(benchmark::State &state, bool per_lobe, smx_grade grade) {
    const ShadingCase what = shading_case(per_lobe, static_cast<int>(state.range(0)));
    smx_material material = nullptr;
    check(make_material(what, &material));
    std::vector<float> picture;
    const auto evaluations = static_cast<double>(render(material, SMX_GRADE_PRECISE, &picture).evaluations);
    const Baselines &base = baselines(what, picture);
    if (base.scalar < 0.0 || base.builtin < 0.0) state.SkipWithError("a baseline's picture is another one");
    render(material, grade); // builds

    double least = std::numeric_limits<double>::infinity();
    for (auto _ : state) {
        const double seconds = render(material, grade).kernel_seconds;
        state.SetIterationTime(seconds);
        least = std::min(least, seconds);
    }
    smx_material_release(material);
    state.counters["ns"] = 1e9 * least / evaluations;
    state.counters["s/eval"] =
        benchmark::Counter(evaluations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["scalar-one-core/ns"] = 1e9 * base.scalar / evaluations;
    state.counters["builtin-kernel/ns"] = 1e9 * base.builtin / evaluations;
    state.counters["scalar-one-core/ratio"] = base.scalar / least;
    state.counters["builtin-kernel/ratio"] = base.builtin / least;
}

void numbers_of_lobes(benchmark::internal::Benchmark *row) {
    row->ArgName("n")->RangeMultiplier(2)->Range(1, 16)->UseManualTime();
}
BENCHMARK_CAPTURE(shade, shared, false, SMX_GRADE_PRECISE)->Name("shade.shared/precise")->Apply(numbers_of_lobes);
BENCHMARK_CAPTURE(shade, shared_fast, false, SMX_GRADE_FAST)->Name("shade.shared/fast")->Apply(numbers_of_lobes);
BENCHMARK_CAPTURE(shade, per_lobe, true, SMX_GRADE_PRECISE)->Name("shade.per-lobe/precise")->Apply(numbers_of_lobes);
BENCHMARK_CAPTURE(shade, per_lobe_fast, true, SMX_GRADE_FAST)->Name("shade.per-lobe/fast")->Apply(numbers_of_lobes);

} // namespace
