// slopemix render: one image of the displaced sphere, by the filter or by one of the references.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "exposure.h"
#include "input.h"
#include "output.h"
#include "progress.h"
#include "render_job.h"

namespace slopemix::cli {

namespace {

constexpr NumberRange rho_range = {-1.0, 1.0}; // its ends are refused: a degenerate covariance
constexpr NumberRange mean_slope_range = {-1e4, 1e4};

double parse_rho(const std::string &text) {
    const double rho = parse_number(text, rho_range);
    if (rho == rho_range.low || rho == rho_range.high)
        throw std::invalid_argument("'" + text + "' is not between -1 and 1");
    return rho;
}

void require_legal_usage(const RenderJob &job) {
    if (std::filesystem::path(job.out).extension() != ".exr")
        throw CLI::ValidationError("--out", "'" + job.out + "' does not end in .exr");
    if (!job.is_filtered() && is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the reference needs a measured table, and '" + job.input + "' is a material file");
    if (job.uniform_light && !job.is_geometric())
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
    note(!job.is_filtered(), {"--lobes", "--model", "--widening-order", "--widening-tolerance"});
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
    return {render_filtered(context, material, view, options),
            info.name,
            info.model,
            info.lobes,
            device.name,
            device.devices};
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
    smx_scene view = scene(job.flags, job.displacement(), job.light_degrees);
    view.light = job.uniform_light ? SMX_LIGHT_UNIFORM : SMX_LIGHT_DIRECTIONAL;
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

void add_scene_flags(CLI::App &command, RenderJob &job) {
    const auto pair_in = [](NumberRange range) {
        return [range](const std::string &text) { return parse_pair(text, range); };
    };
    const auto parse_light = [&job](const std::string &text) {
        job.uniform_light = text == "uniform";
        return job.uniform_light ? 0.0 : parse_number(text, light_range);
    };
    add_parsed(command, "--alpha", job.alpha, pair_in(alpha_range), "Roughness of the displaced surface; 0 is legal")
        ->required()
        ->type_name("AX,AY");
    add_parsed(command, "--rho", job.rho, parse_rho, "Correlation of its two slopes, between -1 and 1 (default 0)")
        ->type_name("R");
    add_parsed(command, "--mean-slope", job.mean_slope, pair_in(mean_slope_range), "Its mean slope (default 0,0)")
        ->type_name("MX,MY");
    add_parsed(
        command, "--light", job.light_degrees, parse_light,
        "Azimuth of the light in degrees: 90 at the camera, 0 to the right, negative behind; or uniform: radiance 1 "
        "from everywhere above (geometric)")
        ->required()
        ->type_name("PHI_DEG|uniform");
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
    add_scene_flags(*command, *job);
    add_fit_flags(*command, job->fit);
    add_render_flags(*command, job->flags);
    add_widening_flags(*command, job->flags);
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
        note_flags_without_effect(*command, *job);
        if (job->is_geometric()) {
            job->flags.target_error = 0.0;
            if (command->count("--spp") == 0) job->flags.spp = geometric_spp;
        }
        run(*job);
    });
}

} // namespace slopemix::cli
