// slopemix render: one image of the displaced sphere, by the filter or by one of the references.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "effect_flags.h"
#include "exposure.h"
#include "input.h"
#include "output.h"
#include "progress.h"
#include "render_job.h"

namespace slopemix::cli {

namespace {

void require_legal_usage(const RenderJob &job) {
    if (std::filesystem::path(job.out).extension() != ".exr")
        throw CLI::ValidationError("--out", "'" + job.out + "' does not end in .exr");
    if (!job.is_filtered() && is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the reference needs a measured table, and '" + job.input + "' is a material file");
    if (job.scene.uniform_light && !job.is_geometric())
        throw CLI::ValidationError("--light", "uniform light needs --integrator geometric");
    if (job.is_geometric()) return require_legal_realisations(job.geometric, job.flags.spp, job.errors);
    require_legal_sampling(job.flags);
    if (job.errors) require_estimate(job.flags);
}

using Flags = std::initializer_list<const char *>;

// A flag of another integrator is no error, so that one set of flags serves all; but it is said.
void note_flags_without_effect(const CLI::App &command, const RenderJob &job) {
    const auto note = [&](bool without_effect, Flags flags) {
        for (const char *flag : flags)
            if (without_effect && command.count(flag) > 0)
                std::cerr << "slopemix: note: " << flag << " has no effect with --integrator "
                          << word_for(job.integrator, integrators) << '\n';
    };
    note(!job.is_filtered(), {"--lobes", "--model", "--widening-order", "--widening-tolerance", "--effect-tolerance"});
    note(!job.is_reference(), {"--target-error", "--sampler"});
    note(job.is_filtered(), {"--spp", "--seed", "--lookup", "--errors"});
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

Rendered render_filtered(const RenderJob &job, const smx_scene &view, const smx_render_options &options) {
    const Context context = open_context(job.flags);
    const Material material =
        is_material_file(job.input) ? load_material(job) : fit(invert(open_brdf(job.input)), job.fit);
    const smx_material_info info = info_of(material);
    const smx_device_info device = info_of(context);
    Rendered rendered = {render_filtered(context, material, view, options),
                         info.name,
                         info.model,
                         info.lobes,
                         device.name,
                         device.devices};
    rendered.effects = SMX_EFFECT_REPORT_INIT;
    check(smx_material_effects(material.get(), &view, &options, &*rendered.effects));
    return rendered;
}

// By one of the references, which take a table.
Rendered render_table(const RenderJob &job, const smx_scene &view, const smx_render_options &options) {
    const Context context = open_context(job.flags);
    const Brdf brdf = open_brdf(job.input);
    const smx_device_info device = info_of(context);
    return {job.is_geometric() ? render_geometric(context, brdf, view, options, job.geometric.options())
                               : render_reference(context, brdf, view, options),
            info_of(brdf).name,
            SMX_MODEL_SHARED,
            0,
            device.name,
            device.devices};
}

// Into memory, or where there is a path, straight into that file.
Rendered render(const RenderJob &job, const char *exr_path) {
    smx_scene view = scene(job.flags, job.scene.displacement(), job.scene.light_degrees);
    view.light = job.scene.uniform_light ? SMX_LIGHT_UNIFORM : SMX_LIGHT_DIRECTIONAL;
    smx_render_options options = render_options(job.flags);
    options.errors = job.errors;
    options.exr_path = exr_path;
    Progress progress(1.0);
    progress.attach(options);

    progress.start("rendering " + name_of(job.input), 1.0);
    Rendered rendered = job.is_filtered() ? render_filtered(job, view, options) : render_table(job, view, options);
    progress.finish();
    return rendered;
}

Rendered render_in_memory(const RenderJob &job, StagedFiles &files) {
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

Rendered render_into_file(const RenderJob &job, StagedFiles &files) {
    Rendered rendered;
    files.write(job.out, [&](const auto &file) { rendered = render(job, file.c_str()); });
    return rendered;
}

void run(const RenderJob &job) {
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
               "surface itself")
        ->required();
    add_surface_flags(*command, job->scene);
    add_light_flag(*command, job->scene, true);
    add_fit_flags(*command, job->fit);
    add_render_flags(*command, job->flags);
    add_widening_flags(*command, job->flags);
    add_effect_flags(*command, job->flags);
    add_geometric_flags(*command, job->geometric);
    command->add_option("--out", job->out, "The image to write")->required()->type_name("X.exr");
    command->add_flag("--errors", job->errors,
                      "Also write the reference's standard errors, as channels error.R, error.G, error.B");
    command->add_flag("--png", job->png, "Also write X.png: sRGB, the 99th percentile at 0.9");
    command->add_flag("--json", job->json, "Print JSON");
    command->footer(
        "The flags of the reference (--spp, --target-error, --sampler, --seed, --lookup, --errors) have no effect on\n"
        "filtered images, nor those of the fit (--lobes, --model) on the references. The geometric one takes --spp\n"
        "(default 4096), --seed, --lookup and --errors too. A material file must hold what "
        "the\n"
        "latter two ask for. Images of more than 2048 x 2048 pixels are written as they come, without being held in\n"
        "memory, unless --png asks for them.");
    command->callback([command, job] {
        job->lobes_given = command->count("--lobes") > 0;
        job->model_given = command->count("--model") > 0;
        require_consistent_effects(*command, job->flags);
        note_flags_without_effect(*command, *job);
        if (job->is_geometric()) {
            job->flags.target_error = 0.0;
            if (command->count("--spp") == 0) job->flags.spp = geometric_spp;
        }
        run(*job);
    });
}

} // namespace slopemix::cli
