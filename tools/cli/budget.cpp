// slopemix budget: how much of the filtered rendering's error is from the inversion, the fit and the widening.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "budget_job.h"
#include "commands.h"
#include "input.h"

namespace slopemix::cli {

namespace {

void require_legal_usage(const BudgetJob &job) {
    require_legal_sampling(job.flags);
    if (is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the budget needs a measured table, and '" + job.input + "' is a material file");
}

// The default target gives way to a number of samples, and to the grid, which has no estimate of its error.
void drop_default_target(const CLI::App &command, RenderFlags &flags) {
    if (command.count("--target-error") > 0) return;
    if (command.count("--spp") > 0 || flags.sampler == SMX_SAMPLER_GRID) flags.target_error = 0.0;
}

void run(const BudgetJob &job) {
    require_legal_usage(job);
    const BudgetResult result = measure_budget(job);
    if (job.json)
        print_budget_json(job, result);
    else
        print_budget_text(job, result);
}

void add_configuration_flags(CLI::App &command, BudgetJob &job) {
    const auto parse_alpha = [](const std::string &text) { return parse_pair(text, alpha_range); };
    add_repeated(command, "--alpha", job.alphas, parse_alpha,
                 "Roughness of the displaced surface, any number of times (default 0.1,0.1 0.25,0.25 0.5,0.5 0.25,0 "
                 "0,0.25 0,0)")
        ->type_name("AX,AY");
    const auto parse_light = [](const std::string &text) { return parse_number(text, light_range); };
    add_repeated(command, "--light", job.lights, parse_light,
                 "Azimuth of the light in degrees, any number of times (default 90 0 -25)")
        ->type_name("PHI_DEG");
    const auto parse_lobes = [](const std::string &text) {
        return static_cast<std::uint32_t>(parse_count(text, lobes_range));
    };
    add_parsed(command, "--lobes", job.lobes, parse_lobes, "Beckmann lobes to fit, 1 to 64 (default 8)")
        ->type_name("N");
}

} // namespace

void add_budget(CLI::App &app) {
    CLI::App *command = app.add_subcommand(
        "budget", "Split the error of filtered renderings into that of the inversion, the fit and the widening");
    const auto job = std::make_shared<BudgetJob>();
    command->add_option("INPUT", job->input, "A MERL table (.binary), builtin:NAME or analytic:KIND,...")
        ->required()
        ->type_name("");
    add_configuration_flags(*command, *job);
    add_sampling_flags(*command, job->flags);
    add_widening_flags(*command, job->flags);
    add_grade_flag(*command, job->flags);
    command->add_flag("--json", job->json, "Print JSON, with the values of every light");
    command->footer(
        "relRMSE, mean over the lights, for both models:\n"
        "  inversion  reference of the inverted slope density's table against the measured table's (shared only)\n"
        "  fit        reference of the fitted base's table against the measured table's\n"
        "  widening   filtered rendering against the reference of the fitted base's table\n"
        "  total      filtered rendering against the reference of the measured table\n"
        "The parts are distances between images and do not add up to the total. --spp and the grid take the place of\n"
        "the default --target-error.");
    command->callback([command, job] {
        drop_default_target(*command, job->flags);
        note_tolerance_without_effect(*command, job->flags.has_auto_order());
        run(*job);
    });
}

} // namespace slopemix::cli
