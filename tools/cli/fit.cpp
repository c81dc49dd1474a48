// slopemix fit: measured tables and slope densities to material files, many at a time; what is up to date stays.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "commands.h"
#include "fit_compare.h"
#include "fit_job.h"
#include "fit_report.h"
#include "fit_row.h"
#include "fit_table.h"
#include "fit_worker.h"
#include "folder_lock.h"
#include "output.h"
#include "plot.h"
#include "progress.h"
#include "workers.h"

namespace slopemix::cli {

namespace {

constexpr CountRange jobs_range = {1, 256};

void refuse_equal_names(const FitJob &job) {
    std::map<std::string, std::string> input_of_file = {{FitTable::json_in(job.out).string(), "the table of the fits"}};
    for (const std::string &input : job.inputs) {
        const std::string file = job.file_for(input).string();
        const auto [other, is_new] = input_of_file.emplace(file, "'" + input + "'");
        if (!is_new)
            throw CLI::ValidationError("INPUT",
                                       other->second + " and '" + input + "' would both be written to " + file);
    }
}

void require_writable_outputs(const FitJob &job) {
    for (const std::string &input : job.inputs) {
        require_writable(job.file_for(input));
        if (job.plot) require_writable(job.plot_for(input));
    }
    require_writable(FitTable::json_in(job.out));
    require_writable(FitTable::csv_in(job.out));
}

// All that a run may write.
std::vector<std::filesystem::path> files_of(const FitJob &job) {
    std::vector<std::filesystem::path> files = {FitTable::json_in(job.out), FitTable::csv_in(job.out)};
    for (const std::string &input : job.inputs) {
        files.push_back(job.file_for(input));
        files.push_back(job.plot_for(input));
    }
    return files;
}

// All inputs on their threads. What is finished is in the table, and in the outcomes, whatever comes after it.
class FitRun {
  public:
    explicit FitRun(const FitJob &job) : job_(job), table_(job.out), worker_(job, table_) {}

    void process_all() {
        Progress progress(static_cast<double>(job_.inputs.size()));
        if (job_.inputs.size() > 1) progress.start("fitting", 0.0);
        run_on_threads(
            job_.inputs.size(), job_.jobs, [&](std::size_t index) { return worker_.process(index); },
            [&](FitOutcome outcome) {
                keep(outcome);
                progress.advance(name_of(job_.inputs[outcome.index]), 1.0);
            });
    }

    void print() const { print_fits(job_, outcomes_, worker_.build_seconds()); }

    // Something was finished without all that was asked for.
    bool cancelled() const {
        return std::any_of(outcomes_.begin(), outcomes_.end(), [](const FitOutcome &o) { return o.cancelled; });
    }

    std::size_t report_failures() const {
        std::size_t failures = 0;
        for (const FitOutcome &outcome : outcomes_) {
            if (outcome.error.empty()) continue;
            ++failures;
            std::cerr << "slopemix: " << outcome.error << '\n';
        }
        return failures;
    }

  private:
    void keep(const FitOutcome &outcome) {
        const auto later = [](const FitOutcome &a, const FitOutcome &b) { return a.index < b.index; };
        outcomes_.insert(std::upper_bound(outcomes_.begin(), outcomes_.end(), outcome, later), outcome);
        if (outcome.fitted) table_.put(fit_row(*outcome.fitted));
        table_.save();
    }

    const FitJob &job_;
    FitTable table_;
    const FitWorker worker_;
    std::vector<FitOutcome> outcomes_; // in the order of the inputs
};

void compare(const FitJob &job) {
    if (job.inputs.size() != 1) throw CLI::ValidationError("--compare", "it takes one INPUT, the source");
    compare_tables(job.compare, job.inputs[0], job.json);
}

void run(const FitJob &job) {
    if (!job.compare.empty()) return compare(job);
    if (job.out.empty()) throw CLI::RequiredError("--out");
    refuse_equal_names(job);
    for (const std::string &input : job.inputs) fit_flags_for(input, job.fit); // wrong usage is found before any work
    if (job.plot) require_gnuplot();
    require_writable_outputs(job);
    const FolderLock lock(job.out); // the table of fits is one run's at a time
    remove_leftovers(files_of(job));
    FitRun fits(job);
    bool cancelled = false;
    try {
        fits.process_all();
    } catch (const Cancelled &) {
        cancelled = true;
    }
    cancelled = cancelled || fits.cancelled();
    fits.print();
    const std::size_t failures = fits.report_failures();
    if (cancelled)
        throw CommandError(job.refit ? "cancelled; what was not fitted again is as it was"
                                     : "cancelled; the same command goes on from here");
    if (failures > 0)
        throw CommandError(std::to_string(failures) + " of " + std::to_string(job.inputs.size()) + " inputs failed");
}

} // namespace

void add_fit(CLI::App &app) {
    CLI::App *command = app.add_subcommand(
        "fit",
        "Fit measured tables or slope densities and write material files, DIR/<name>.json, and a row each of "
        "DIR/fits.csv and .json");
    const auto job = std::make_shared<FitJob>();
    job->jobs = std::clamp<std::size_t>(std::thread::hardware_concurrency(), jobs_range.low, jobs_range.high);
    command
        ->add_option("INPUT", job->inputs,
                     "MERL tables (.binary), builtin:NAME, analytic:KIND,... (see synth) or density:FILE.csv")
        ->required()
        ->type_name("");
    command->add_option("--out", job->out, "Folder of the material files")->type_name("DIR");
    add_fit_flags(*command, job->fit);
    const auto parse_jobs = [](const std::string &text) { return parse_count(text, jobs_range); };
    add_parsed(*command, "--jobs", job->jobs, parse_jobs, "Materials at the same time, 1 to 256 (default: the cores)")
        ->type_name("N");
    CLI::Option *refit =
        command->add_flag("--refit", job->refit, "Fit also what is up to date: same table, options and version");
    command
        ->add_flag("--resume", job->resume,
                   "Go on where an interrupted run stopped: materials of DIR that are up to date stay, the others are "
                   "fitted. So does fit by itself; with the flag, --refit is refused")
        ->excludes(refit);
    command->add_flag("--metrics", job->metrics,
                      "Also measure the errors of both models and of three baselines in BRDF space (docs/metrics.md), "
                      "about 2 s a material, for the report, fits.csv and fits.json");
    command->add_flag("--plot", job->plot, "Draw each fit with gnuplot: DIR/<name>.svg");
    CLI::Option *compare =
        command
            ->add_option("--compare", job->compare,
                         "Fit nothing: print the errors of this table against INPUT, its source, in BRDF space")
            ->type_name("OTHER.binary");
    for (const char *of_a_fit : {"--out", "--lobes", "--model", "--jobs", "--refit", "--resume", "--metrics", "--plot"})
        compare->excludes(of_a_fit);
    command->add_flag("--json", job->json, "Print JSON");
    command->callback([job] { run(*job); });
}

} // namespace slopemix::cli
