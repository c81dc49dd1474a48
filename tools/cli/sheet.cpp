// slopemix sheet: the displaced-sphere experiment, 90 images with their errors and a contact sheet.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.h"
#include "folder_lock.h"
#include "input.h"
#include "sheet_job.h"
#include "sheet_journal.h"
#include "sheet_record.h"

namespace slopemix::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr Choice<bool> sheet_models[] = {{"shared", false}, {"both", true}};

SheetPlan plan_of(const SheetJob &job) {
    SheetPlan plan(job.radii, job.lobes, job.per_lobe_orders());
    try {
        plan.images(job.only);
    } catch (const std::invalid_argument &error) {
        throw CLI::ValidationError("--only", error.what());
    }
    return plan;
}

void require_legal_usage(const SheetJob &job) {
    require_legal_sampling(job.flags);
    if (is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the sheet needs a measured table, and '" + job.input + "' is a material file");
}

void require_writable_report(const SheetJob &job) {
    require_writable(job.file("sheet.json"));
    require_writable(job.file("sheet.png"));
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

// Measures the images, and puts sheet.json and sheet.png in their places.
void report(const SheetJob &job, const SheetPlan &plan, SheetResult &result, Clock::time_point begin) {
    measure_sheet(job, plan, result);
    StagedFiles files;
    files.write(job.file("sheet.png"), [&](const auto &file) { draw_sheet(job, plan, result, file); });
    result.total_seconds = result.earlier_seconds + std::chrono::duration<double>(Clock::now() - begin).count();
    const std::string document = sheet_json(job, result);
    files.write(job.file("sheet.json"), [&](const auto &file) { write_text(file, document); });
    files.commit();

    if (job.json)
        std::cout << document;
    else
        print_summary(job, result);
}

void run_whole(const SheetJob &job, const SheetPlan &plan) {
    const auto begin = Clock::now();
    require_writable_report(job);
    require_writable(job.journal_file());
    for (const SheetImage &image : plan.images({})) require_writable(job.image_file(image.id));

    SheetJournal journal(job, plan);
    SheetResult result = render(job, plan, journal);
    if (journal.is_complete()) return print_complete(job);
    report(job, plan, result, begin);
    journal.close();
}

void run_images(const SheetJob &job, const SheetPlan &plan) {
    for (const SheetImage &image : plan.images(job.only)) {
        require_writable(job.image_file(image.id));
        require_writable(job.record_file(image.id));
    }
    const std::vector<SheetRecord> records = render_records(job, plan);
    if (!job.json) {
        std::cout << records.size() << " images, and a record of each, in " << job.out << '\n';
        return;
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const SheetRecord &record : records)
        list.push_back(image_json(record.entry, record.fit ? &*record.fit : nullptr));
    std::cout << list.dump(2) << '\n';
}

void run_collect(const SheetJob &job, const SheetPlan &plan) {
    const auto begin = Clock::now();
    require_writable_report(job);
    const FolderLock lock(job.out, FolderLock::Mode::beside_others);
    SheetResult result = collect_sheet(job, plan);
    report(job, plan, result, begin);
}

void run(const SheetJob &job) {
    require_legal_usage(job);
    const SheetPlan plan = plan_of(job);
    if (job.collect)
        run_collect(job, plan);
    else if (!job.only.empty())
        run_images(job, plan);
    else
        run_whole(job, plan);
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
    add_parsed(*command, "--only", job->only, parse_image_ids,
               "Only these images: T.R.C.exr and its record T.R.C.json, and neither sheet.json nor sheet.png")
        ->type_name("T.R.C,...");
    CLI::Option *collect = command->add_flag("--collect", job->collect,
                                             "Render nothing: the errors, sheet.json and sheet.png of images that "
                                             "--only rendered, all or, with --only, these");
    command
        ->add_option("--fit", job->fit_files,
                     "A material file in place of a fit, for each that the sheet needs, in the columns' order")
        ->type_name("FILE.json")
        ->allow_extra_args(false)
        ->excludes(collect);
    add_render_flags(*command, job->flags);
    command
        ->add_flag("--resume", job->resume,
                   "Go on where an interrupted sheet of DIR stopped, with its finished images; a whole sheet of other "
                   "settings is refused, and an image that --only names is rendered again")
        ->excludes(collect);
    command->add_flag("--json", job->json, "Print sheet.json; with --only alone, a list of its images");
    command->footer(
        "Tables T: 1 isotropic (alpha r,r), 2 latitudinal (r,0), 3 longitudinal (0,r). Rows R: one per radius.\n"
        "Columns C: 1 the geometry, then for each light (90, 0, -25 degrees) the reference and one filtered image per\n"
        "entry of --lobes under the shared model; with --model both, then the per-lobe model for each light; with\n"
        "--widening-order, then the same for each order and light, the closed form first.\n"
        "Calls with --only are independent of each other, on one machine or many, and may run at once and again; they\n"
        "and --collect need the same settings, from --radii to --grade. A filtered image that is collected needs the\n"
        "reference of its row and light.\n"
        "A finished image is in its place at once. That of a whole sheet is listed in sheet.partial.json until the "
        "sheet\n"
        "is whole. The first other image takes away an earlier sheet.json and sheet.png: what is interrupted leaves\n"
        "neither.");
    command->callback([command, job] {
        note_tolerance_without_effect(*command, job->has_auto_order());
        run(*job);
    });
}

} // namespace slopemix::cli
