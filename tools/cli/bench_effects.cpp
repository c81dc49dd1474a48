// What each effect costs: filtered shading with all effects beside the same without one, and without any.
#include "bench_job.h"
#include "effect_flags.h"
#include "renderings.h"
#include "shading.h"

namespace slopemix::cli {

namespace {

constexpr int pairs_per_round = 9;

// All that filtered shading simulates.
constexpr std::uint32_t all_effects = SMX_EFFECT_MASKING | SMX_EFFECT_SHADOWING | SMX_EFFECT_HEIGHT_CORRELATION |
                                      SMX_EFFECT_FRESNEL | SMX_EFFECT_LOBE_COLOR | SMX_EFFECT_ANISOTROPY |
                                      SMX_EFFECT_MEAN_SLOPE;

struct Variant {
    std::string name;
    std::uint32_t effects;
};

std::vector<Variant> variants() {
    std::vector<Variant> list = {{"none", SMX_EFFECTS_NONE}};
    for (std::uint32_t effect = 1; effect < SMX_EFFECT_INTERREFLECTION; effect *= 2)
        list.push_back(
            {std::string("without-") + smx_effect_name(static_cast<smx_effect>(effect)), all_effects & ~effect});
    return list;
}

void add_run(Times &times, BenchJob &job, const Material &material, std::uint32_t effects) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = effects;
    job.progress.attach(options);
    times.add(render_filtered(job.context, material, shading_scene(), options).report);
}

void bench_lobes(BenchJob &job, int count) {
    const ShadingCase what = shading_case(true, count);
    const Material material = acquire<Material>([&](smx_material *made) { return make_material(what, made); });
    for (const auto &[name, effects] : variants()) {
        Times without, with, compiled;
        add_run(compiled, job, material, effects);
        add_run(compiled, job, material, all_effects);
        for (int pair = 0; pair < job.rounds * pairs_per_round; ++pair) { // what disturbs one disturbs both
            add_run(without, job, material, effects);
            add_run(with, job, material, all_effects);
        }
        job.rows.push_back({"effects." + name + ".n" + std::to_string(count), SMX_GRADE_PRECISE, without.median(),
                            "all-effects", with.median()});
    }
}

} // namespace

void bench_effects(BenchJob &job) {
    for (const int count : effect_lobe_counts) {
        job.progress.start("effects", 1.0);
        bench_lobes(job, count);
        job.progress.finish();
    }
}

} // namespace slopemix::cli
