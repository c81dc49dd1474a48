// slopemix render: one image of the displaced sphere, by the filter or by one of the references.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands.h"
#include "effect_flags.h"
#include "exposure.h"
#include "input.h"
#include "output.h"
#include "progress.h"
#include "render_job.h"

namespace slopemix::cli {

namespace {

// What takes one direction of light takes no uniform one.
void require_legal_uniform(const RenderJob &job) {
    if (job.choose.is_asked_for())
        throw CLI::ValidationError("--light", "a choice by error or time takes no uniform light; use --integrator");
    if (job.is_filtered() && job.flags.has_auto_order())
        throw CLI::ValidationError("--widening-order",
                                   "auto takes no uniform light; use 0.." + std::to_string(SMX_WIDENING_MAX_ORDER));
    if (job.is_reference() && job.flags.sampler == SMX_SAMPLER_GRID)
        throw CLI::ValidationError("--sampler", "the grid takes no uniform light; use sobol or mis");
}

void require_legal_usage(const RenderJob &job) {
    if (std::filesystem::path(job.out).extension() != ".exr")
        throw CLI::ValidationError("--out", "'" + job.out + "' does not end in .exr");
    if (!job.choose.is_asked_for() && !job.is_filtered() && is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the reference needs a measured table, and '" + job.input + "' is a material file");
    if (job.is_geometric()) return require_legal_realisations(job.geometric, job.flags.spp, job.errors);
    if (job.scene.uniform_light) require_legal_uniform(job);
    require_legal_sampling(job.flags);
    if (job.errors) require_estimate(job.flags);
}

// An image is made by an integrator, or as is chosen.
void require_way(const CLI::App &command, const RenderJob &job) {
    if (!job.choose.is_asked_for() && command.count("--integrator") == 0)
        throw CLI::RequiredError("--integrator (or --max-error, or --max-seconds)");
    if (!job.choose.is_asked_for() && !job.choose.materials.empty())
        throw CLI::ValidationError("--material", "needs --max-error or --max-seconds");
    const bool names_effects = job.flags.effects != SMX_EFFECTS_AUTO && job.flags.effects != SMX_EFFECTS_ALL;
    if (job.choose.is_asked_for() && names_effects)
        throw CLI::ValidationError("--effects",
                                   "a choice by error or time is among images of all effects; use auto "
                                   "or all");
    if (job.choose.is_asked_for() && job.errors)
        throw CLI::ValidationError("--errors", "the choice may fall on a filtered image, which has none");
}

using Flags = std::initializer_list<const char *>;

// A flag of another integrator is no error, so that one set of flags serves all; but it is said.
void note_flags_without_effect(const CLI::App &command, const RenderJob &job) {
    const std::string with = job.choose.is_asked_for()
                                 ? "a choice by error or time"
                                 : std::string("--integrator ") + word_for(job.integrator, integrators);
    const auto note = [&](bool without_effect, Flags flags) {
        for (const char *flag : flags)
            if (without_effect && command.count(flag) > 0)
                std::cerr << "slopemix: note: " << flag << " has no effect with " << with << '\n';
    };
    if (job.choose.is_asked_for()) {
        note(true, {"--bounces", "--tile", "--realisations"});
        note(!job.choose.materials.empty() || is_material_file(job.input), {"--lobes", "--model"});
        return;
    }
    note(!job.is_filtered(), {"--lobes", "--model", "--widening-order", "--widening-tolerance", "--effect-tolerance"});
    note(!job.is_reference(), {"--sampler"});
    note(job.is_geometric() || !job.is_sampled(), {"--target-error", "--scrambles"});
    note(!job.is_sampled(), {"--spp", "--seed", "--errors"});
    note(job.is_filtered(), {"--lookup"});
    note(job.is_geometric(), {"--g", "--grade"});
    note(!job.is_geometric(), {"--bounces", "--tile", "--realisations"});
    if (job.is_filtered()) note_tolerance_without_effect(command, job.flags.has_auto_order());
}

Material load_material(const RenderJob &job) {
    Material material = acquire<Material>(smx_material_load, job.input.c_str());
    const smx_material_info info = info_of(material);
    if (job.lobes_given && info.lobes != job.fit.lobes)
        throw CommandError(job.input + " holds " + std::to_string(info.lobes) + " lobes, and --lobes asks for " +
                           std::to_string(job.fit.lobes));
    if (job.model_given && info.model != job.fit.model)
        throw CommandError(job.input + " holds the " + word_for(info.model, models) + " model, and --model asks for " +
                           word_for(job.fit.model, models));
    return material;
}

// What an image is made of: a material for the filter, a table for the references.
struct Source {
    Context context;
    Brdf brdf;
    Material material;
};

Source open_source(const RenderJob &job) {
    Source source{open_context(job.flags), {}, {}};
    if (!job.is_filtered())
        source.brdf = open_brdf(job.input);
    else if (is_material_file(job.input))
        source.material = load_material(job);
    else
        source.material = fit(invert(open_brdf(job.input)), job.fit);
    return source;
}

smx_scene view_of(const RenderJob &job) {
    smx_scene view = scene(job.flags, job.scene.displacement(), job.scene.light_degrees);
    view.light = job.scene.uniform_light ? SMX_LIGHT_UNIFORM : SMX_LIGHT_DIRECTIONAL;
    return view;
}

// Chooses, and leaves the choice in the job's flags.
Chosen choose(RenderJob &job, Source &source, Progress &progress) {
    source.context = open_context(job.flags);
    Candidates candidates = open_candidates(job.input, job.choose, job.fit, job.lobes_given);
    smx_render_options options = render_options(job.flags);
    progress.attach(options);
    Chosen chosen = choose(source.context, candidates, view_of(job), options, job.choose);
    const smx_configuration &picked = chosen.choice.picked;
    if (picked.material == SMX_BY_REFERENCE) {
        job.integrator = Integrator::reference;
        job.flags.sampler = picked.sampler;
        job.flags.spp = picked.spp;
        source.brdf = std::move(candidates.brdf);
    } else {
        job.integrator = Integrator::filtered;
        job.flags.widening_order = picked.widening_order;
        // What effects are left out for is no error to speak of beside the one that was asked for.
        if (job.choose.max_error > 0.0)
            job.flags.effect_tolerance = std::min(job.flags.effect_tolerance, 0.1 * job.choose.max_error);
        source.material = std::move(candidates.materials[static_cast<std::size_t>(picked.material)]);
    }
    return chosen;
}

Rendered render_filtered(const Source &source, const smx_scene &view, const smx_render_options &options) {
    const smx_material_info info = info_of(source.material);
    const smx_device_info device = info_of(source.context);
    Rendered rendered = {render_filtered(source.context, source.material, view, options),
                         info.name,
                         info.model,
                         info.lobes,
                         device.name,
                         device.devices};
    if (view.light == SMX_LIGHT_UNIFORM) return rendered; // nothing was judged
    rendered.effects = SMX_EFFECT_REPORT_INIT;
    check(smx_material_effects(source.material.get(), &view, &options, &*rendered.effects));
    return rendered;
}

// By one of the references, which take a table.
Rendered render_table(const RenderJob &job, const Source &source, const smx_scene &view,
                      const smx_render_options &options) {
    const smx_device_info device = info_of(source.context);
    return {job.is_geometric() ? render_geometric(source.context, source.brdf, view, options, job.geometric.options())
                               : render_reference(source.context, source.brdf, view, options),
            info_of(source.brdf).name,
            SMX_MODEL_SHARED,
            0,
            device.name,
            device.devices};
}

// Into memory, or where there is a path, straight into that file.
Rendered render(RenderJob &job, const char *exr_path) {
    Progress progress(1.0);
    progress.start("rendering " + name_of(job.input), 1.0);
    Source source;
    std::optional<Chosen> chosen;
    if (job.choose.is_asked_for())
        chosen = choose(job, source, progress);
    else
        source = open_source(job);

    const smx_scene view = view_of(job);
    smx_render_options options = render_options(job.flags);
    options.errors = job.errors && job.is_sampled();
    options.exr_path = exr_path;
    progress.attach(options);
    Rendered rendered =
        job.is_filtered() ? render_filtered(source, view, options) : render_table(job, source, view, options);
    rendered.chosen = chosen;
    progress.finish();
    return rendered;
}

Rendered render_in_memory(RenderJob &job, StagedFiles &files) {
    Rendered rendered = render(job, nullptr);
    const smx_image image = rendered.rendering.image.get();
    files.write(job.out, [&](const auto &file) { check(smx_image_write_exr(image, file.c_str())); });
    if (job.png) {
        rendered.exposure = exposure_for(bright_value(rendered.rendering.image));
        files.write(job.png_file(),
                    [&](const auto &file) { check(smx_image_write_png(image, file.c_str(), rendered.exposure)); });
    }
    return rendered;
}

Rendered render_into_file(RenderJob &job, StagedFiles &files) {
    Rendered rendered;
    files.write(job.out, [&](const auto &file) { rendered = render(job, file.c_str()); });
    return rendered;
}

void run(RenderJob &job) {
    require_legal_usage(job);
    require_writable(job.out);
    if (job.png) require_writable(job.png_file());
    StagedFiles files;
    const Rendered rendered = job.is_streamed() ? render_into_file(job, files) : render_in_memory(job, files);
    files.commit();
    if (job.json)
        print_json(job, rendered);
    else
        print_text(job, rendered);
}

} // namespace

void add_render(CLI::App &app) {
    CLI::App *command = app.add_subcommand("render", "Render the displaced sphere into an EXR file");
    const auto job = std::make_shared<RenderJob>();
    command
        ->add_option("INPUT", job->input,
                     "A MERL table (.binary), builtin:NAME, analytic:KIND,... or a material file (.json)")
        ->required()
        ->type_name("");
    add_choice(*command, "--integrator", job->integrator, integrators,
               "The mixture widened by the surface, the measured table integrated over its facets, or rays against the "
               "surface itself; needed unless --max-error or --max-seconds chooses");
    add_surface_flags(*command, job->scene);
    add_light_flag(*command, job->scene, true);
    add_fit_flags(*command, job->fit);
    add_render_flags(*command, job->flags);
    add_widening_flags(*command, job->flags);
    add_effect_flags(*command, job->flags);
    add_geometric_flags(*command, job->geometric);
    add_choose_flags(*command, job->choose);
    command->add_option("--out", job->out, "The image to write")->required()->type_name("X.exr");
    command->add_flag("--errors", job->errors,
                      "Also write the reference's standard errors, as channels error.R, error.G, error.B");
    command->add_flag("--png", job->png, "Also write X.png: sRGB, the 99th percentile at 0.9");
    command->add_flag("--json", job->json, "Print JSON");
    command->footer(
        "The flags of the reference (--spp, --target-error, --sampler, --scrambles, --seed, --lookup, --errors) have "
        "no\n"
        "effect on filtered images, nor those of the fit (--lobes, --model) on the references. The geometric one takes "
        "--spp\n"
        "(default 4096), --seed, --lookup and --errors too. Under a uniform light filtered images are sampled as "
        "well:\n"
        "they take --spp (default 4096, also of the reference), --target-error, --scrambles, --seed and --errors;\n"
        "auto effects are all, and --widening-order auto, --sampler grid, --max-error and --max-seconds are refused. A "
        "material file\n"
        "must hold what --lobes and --model ask for. Images of more than 2048 x 2048 pixels are written as they come, "
        "without being held in\n"
        "memory, unless --png asks for them.");
    command->callback([command, job] {
        job->lobes_given = command->count("--lobes") > 0;
        job->model_given = command->count("--model") > 0;
        require_way(*command, *job);
        require_consistent_effects(*command, job->flags);
        note_flags_without_effect(*command, *job);
        if (job->is_geometric()) {
            job->flags.target_error = 0.0;
        }
        // Of the references under a directional light, samples are far cheaper.
        if ((job->is_geometric() || job->scene.uniform_light) && command->count("--spp") == 0)
            job->flags.spp = geometric_spp;
        run(*job);
    });
}

} // namespace slopemix::cli
