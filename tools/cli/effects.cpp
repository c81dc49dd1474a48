// slopemix effects: which effects an image calls for, why, and what each costs.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_job.h"
#include "commands.h"
#include "effect_flags.h"
#include "effect_report.h"
#include "input.h"
#include "renderings.h"
#include "scene_flags.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

// Kernel times of images this large.
constexpr std::uint32_t timed_side = 512;
constexpr int timed_rounds = 9;

struct EffectsJob {
    std::string input;
    FitFlags fit;
    SceneFlags scene;
    RenderFlags flags;
    bool json = false;
};

// Nanoseconds per evaluation.
struct Costs {
    double everything = 0.0, chosen = 0.0;
    std::array<std::optional<double>, SMX_EFFECT_COUNT> without; // everything but the effect, where it is supported
};

struct Judged {
    smx_material_info material;
    smx_effect_report report;
    Costs costs;
};

std::uint32_t supported_effects(const smx_effect_report &report, smx_masking masking) {
    std::uint32_t effects = 0;
    for (const smx_effect_verdict &verdict : report.verdicts)
        if (verdict.supported) effects |= verdict.effect;
    return masking == SMX_G2_CORRELATED ? effects : effects & ~std::uint32_t{SMX_EFFECT_HEIGHT_CORRELATION};
}

// All variants take turns; the first turn compiles.
Costs measure(const Context &context, const Material &material, smx_scene view, smx_render_options options,
              const smx_effect_report &report) {
    view.width = view.height = timed_side;
    const std::uint32_t all = supported_effects(report, view.masking);
    std::uint32_t chosen = 0;
    for (const smx_effect_verdict &verdict : report.verdicts)
        if (verdict.on) chosen |= verdict.effect;
    std::vector<std::uint32_t> variants = {all, chosen};
    for (const smx_effect_verdict &verdict : report.verdicts)
        variants.push_back(all & verdict.effect ? all & ~std::uint32_t{verdict.effect} : all);
    std::vector<Times> times(variants.size());
    Progress progress(timed_rounds + 1.0);
    for (int round = 0; round <= timed_rounds; ++round) {
        progress.start("measuring effects", 1.0);
        for (std::size_t v = 0; v < variants.size(); ++v) {
            options.effects = variants[v];
            const Rendering rendering = render_filtered(context, material, view, options);
            if (round > 0) times[v].add(rendering.report);
        }
        progress.finish();
    }
    Costs costs = {times[0].median(), times[1].median(), {}};
    for (std::size_t k = 0; k < SMX_EFFECT_COUNT; ++k)
        if (all & report.verdicts[k].effect) costs.without[k] = times[k + 2].median();
    return costs;
}

Material open_material(const EffectsJob &job) {
    if (is_material_file(job.input)) return acquire<Material>(smx_material_load, job.input.c_str());
    return fit(open_density(job.input), fit_flags_for(job.input, job.fit));
}

Judged judge(const EffectsJob &job) {
    const Material material = open_material(job);
    const smx_scene view = scene(job.flags, job.scene.displacement(), job.scene.light_degrees);
    smx_render_options options = render_options(job.flags);
    options.effects = SMX_EFFECTS_AUTO;
    Judged judged = {info_of(material), SMX_EFFECT_REPORT_INIT, {}};
    check(smx_material_effects(material.get(), &view, &options, &judged.report));
    judged.costs = measure(open_context(job.flags), material, view, options, judged.report);
    return judged;
}

void print_json(const EffectsJob &job, const Judged &judged) {
    Json effects = verdicts_json(judged.report);
    for (std::size_t k = 0; k < effects.size(); ++k) {
        const std::optional<double> without = judged.costs.without[k];
        effects[k]["ns_with"] = without ? Json(judged.costs.everything) : Json();
        effects[k]["ns_without"] = without ? Json(*without) : Json();
    }
    const Json document = {{"version", SMX_VERSION_STRING},
                           {"input", job.input},
                           {"material", judged.material.name},
                           {"model", word_for(judged.material.model, models)},
                           {"lobes", judged.material.lobes},
                           {"alpha_x", job.scene.alpha.first},
                           {"alpha_y", job.scene.alpha.second},
                           {"rho", job.scene.rho},
                           {"mean_slope", {job.scene.mean_slope.first, job.scene.mean_slope.second}},
                           {"light_phi_deg", job.scene.light_degrees},
                           {"g", word_for(job.flags.masking, maskings)},
                           {"resolution", {job.flags.resolution.width, job.flags.resolution.height}},
                           {"effect_tolerance", job.flags.effect_tolerance},
                           {"effects", effects},
                           {"lobes_shaded", judged.report.lobes},
                           {"left_out", judged.report.left_out},
                           {"ns_all", judged.costs.everything},
                           {"ns_chosen", judged.costs.chosen},
                           {"seconds", judged.report.seconds}};
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_text(const EffectsJob &job, const Judged &judged) {
    std::vector<TextRow> rows = {{"effect", "", "without it", "ns with", "ns without"}};
    for (std::size_t k = 0; k < SMX_EFFECT_COUNT; ++k) {
        const smx_effect_verdict &v = judged.report.verdicts[k];
        const std::optional<double> without = judged.costs.without[k];
        rows.push_back({smx_effect_name(v.effect), v.on ? "on" : "off",
                        v.contribution >= 0.0 ? general(v.contribution, 2) : "-",
                        without ? fixed(judged.costs.everything, 2) : "-", without ? fixed(*without, 2) : "-"});
    }
    print_table(std::cout, rows);
    std::cout << '\n';
    Facts facts;
    for (const smx_effect_verdict &v : judged.report.verdicts) facts.emplace_back(smx_effect_name(v.effect), v.reason);
    facts.emplace_back("lobes", dropped_text(judged.report, judged.material.lobes));
    facts.emplace_back("left out", general(judged.report.left_out, 2) + " of the image, of a tolerance of " +
                                       general(job.flags.effect_tolerance, 2));
    facts.emplace_back("per evaluation", fixed(judged.costs.everything, 2) + " ns with all effects, " +
                                             fixed(judged.costs.chosen, 2) + " with these");
    print_facts(std::cout, facts);
}

} // namespace

void add_effects(CLI::App &app) {
    CLI::App *command =
        app.add_subcommand("effects", "Show which effects a filtered image calls for, why, and what they cost");
    const auto job = std::make_shared<EffectsJob>();
    command
        ->add_option("INPUT", job->input,
                     "A MERL table (.binary), builtin:NAME, analytic:KIND,..., density:FILE.csv or a material file")
        ->required()
        ->type_name("");
    add_surface_flags(*command, job->scene);
    add_light_flag(*command, job->scene, false);
    add_fit_flags(*command, job->fit);
    add_view_flags(*command, job->flags);
    add_grade_flag(*command, job->flags);
    add_widening_flags(*command, job->flags);
    add_effect_tolerance(*command, job->flags);
    command->add_flag("--json", job->json, "Print JSON");
    command->footer(
        "\"without it\" is the image's relRMSE with all effects but this one, as estimated from some of its pixels.\n"
        "Nanoseconds are kernel time per pixel of a 512 x 512 image, with all effects and with all but this one.");
    command->callback([job] {
        const Judged judged = judge(*job);
        job->json ? print_json(*job, judged) : print_text(*job, judged);
    });
}

} // namespace slopemix::cli
