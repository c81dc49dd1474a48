// slopemix sheet: the displaced-sphere experiment, 90 images with their errors and a contact sheet.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "input.h"
#include "sheet_job.h"
#include "sheet_journal.h"

namespace slopemix::cli {

namespace {

constexpr Choice<bool> sheet_models[] = {{"shared", false}, {"both", true}};

SheetPlan plan_of(const SheetJob &job) {
    try {
        return SheetPlan(job.radii, job.lobes, job.per_lobe_orders(), job.only);
    } catch (const std::invalid_argument &error) {
        throw CLI::ValidationError("--only", error.what());
    }
}

void require_legal_usage(const SheetJob &job) {
    require_legal_sampling(job.flags);
    if (is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the sheet needs a measured table, and '" + job.input + "' is a material file");
}

SheetResult render(const SheetJob &job, const SheetPlan &plan, SheetJournal &journal) {
    try {
        return render_sheet(job, plan, journal);
    } catch (const Cancelled &) {
        if (journal.exists()) throw CommandError("cancelled; with --resume the same command goes on from here");
        throw;
    }
}

void print_complete(const SheetJob &job) {
    const std::filesystem::path file = job.file("sheet.json");
    if (job.json)
        std::cout << std::ifstream(file, std::ios::binary).rdbuf();
    else
        std::cout << file.string() << " is there with these settings, and so are its images: nothing to resume\n";
}

void run(const SheetJob &job) {
    const auto begin = std::chrono::steady_clock::now();
    require_legal_usage(job);
    const SheetPlan plan = plan_of(job);
    require_writable(job.file("sheet.json"));
    require_writable(job.file("sheet.png"));
    require_writable(job.journal_file());
    for (const SheetStep &step : plan.steps())
        if (step.is_output) require_writable(job.image_file(step.image.id));

    SheetJournal journal(job, plan);
    SheetResult result = render(job, plan, journal);
    if (journal.is_complete()) return print_complete(job);
    StagedFiles files;
    files.write(job.file("sheet.png"), [&](const auto &file) { draw_sheet(job, plan, result, file); });
    result.total_seconds =
        result.earlier_seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::string document = sheet_json(job, result);
    files.write(job.file("sheet.json"), [&](const auto &file) { write_text(file, document); });
    files.commit();
    journal.close();

    if (job.json)
        std::cout << document;
    else
        print_summary(job, result);
}

} // namespace

void add_sheet(CLI::App &app) {
    CLI::App *command = app.add_subcommand(
        "sheet", "Render the displaced-sphere sheet: T.R.C.exr, the contact sheet sheet.png, and sheet.json");
    const auto job = std::make_shared<SheetJob>();
    command->add_option("INPUT", job->input, "A MERL table (.binary), builtin:NAME or analytic:KIND,...")
        ->required()
        ->type_name("");
    command->add_option("--out", job->out, "Folder of the sheet")->required()->type_name("DIR");
    const auto parse_radii = [](const std::string &text) { return parse_numbers(text, alpha_range); };
    add_parsed(*command, "--radii", job->radii, parse_radii, "Roughnesses r, a row each (default 0.1,0.25,0.5)")
        ->type_name("R,...");
    add_parsed(*command, "--lobes", job->lobes, parse_lobe_counts,
               "Numbers of lobes, a filtered image each (default 1,8)")
        ->type_name("N,...");
    const auto parse_models = [](const std::string &text) { return parse_choice(text, sheet_models); };
    add_parsed(*command, "--model", job->with_per_lobe, parse_models,
               "both: also the per-lobe model with the last of --lobes, behind the other columns (default shared)")
        ->type_name("shared|both");
    add_parsed(*command, "--widening-order", job->widening_orders, parse_widening_orders,
               "More columns: the per-lobe model with the last of --lobes, widened by quadrature of these orders, 0 to "
               "8, or auto; 0 is the closed form, and comes first")
        ->type_name("N,...");
    add_widening_tolerance(*command, job->flags);
    add_parsed(*command, "--only", job->only, parse_image_ids, "Only these images (default all)")
        ->type_name("T.R.C,...");
    add_render_flags(*command, job->flags);
    command->add_flag("--resume", job->resume,
                      "Go on where an interrupted sheet of DIR stopped, with its finished images; other settings than "
                      "its own are refused");
    command->add_flag("--json", job->json, "Print sheet.json");
    command->footer(
        "Tables T: 1 isotropic (alpha r,r), 2 latitudinal (r,0), 3 longitudinal (0,r). Rows R: one per radius.\n"
        "Columns C: 1 the geometry, then for each light (90, 0, -25 degrees) the reference and one filtered image per\n"
        "entry of --lobes under the shared model; with --model both, then the per-lobe model for each light; with\n"
        "--widening-order, then the same for each order and light, the closed form first.\n"
        "A filtered image that --only names without its reference is compared with DIR's, if that was made with the\n"
        "same settings, or else with one that is rendered for the purpose and not kept.\n"
        "A finished image is in its place at once, and listed in sheet.partial.json until the sheet is whole. The\n"
        "first one takes away sheet.json and sheet.png of an earlier sheet: what is interrupted leaves neither.");
    command->callback([command, job] {
        note_tolerance_without_effect(*command, job->has_auto_order());
        run(*job);
    });
}

} // namespace slopemix::cli
