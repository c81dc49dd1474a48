// slopemix tradeoff: what accuracy costs in time, of every method, for one material and scene.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

#include "commands.h"
#include "input.h"
#include "output.h"
#include "plot.h"
#include "renderings.h"
#include "tradeoff_journal.h"
#include "tradeoff_plot.h"

namespace slopemix::cli {

namespace {

constexpr CountRange samples_range = {1, 1u << 20};
constexpr std::uint32_t samples = 65536, quick_samples = 4096;

SweepAxes defaults(bool quick) {
    SweepAxes axes;
    for (const auto &choice : methods) axes.methods.push_back(choice.value);
    axes.samples = quick ? quick_samples : samples;
    axes.lobes = quick ? std::vector<std::uint32_t>{1, 8} : std::vector<std::uint32_t>{1, 2, 4, 8, 16};
    axes.orders = quick ? std::vector<std::int32_t>{0, 1, 3} : std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8};
    return axes;
}

// What was not asked for takes its default, which depends on --quick.
void complete(SweepAxes &axes, bool quick) {
    const SweepAxes all = defaults(quick);
    if (axes.methods.empty()) axes.methods = all.methods;
    if (axes.samples == 0) axes.samples = all.samples;
    if (axes.lobes.empty()) axes.lobes = all.lobes;
    if (axes.orders.empty()) axes.orders = all.orders;
}

void require_legal_usage(const TradeoffJob &job) {
    if (is_material_file(job.input))
        throw CLI::ValidationError("INPUT",
                                   "the sweep needs a measured table, and '" + job.input + "' is a material file");
    if (job.alpha == std::pair(0.0, 0.0))
        throw CLI::ValidationError("--alpha", "0,0 displaces nothing: one sample is exact, and there is no trade");
}

std::vector<Configuration> plan_for(const TradeoffJob &job) {
    std::vector<Configuration> plan = plan_of(job.axes);
    if (plan.empty())
        throw CLI::ValidationError("--samples", "nothing to sweep: " + std::to_string(job.axes.samples) +
                                                    " is less than the methods take; mis needs 2, geometric 16");
    return plan;
}

TradeoffResult measure(const TradeoffJob &job, const std::vector<Configuration> &plan, TradeoffJournal &journal) {
    try {
        return measure_tradeoff(job, plan, journal);
    } catch (const Cancelled &) {
        if (journal.exists()) throw CommandError("cancelled; with --resume the same command goes on from here");
        throw;
    }
}

void print_complete(const TradeoffJob &job) {
    const std::filesystem::path file = job.file("tradeoff.json");
    if (job.json)
        std::cout << std::ifstream(file, std::ios::binary).rdbuf();
    else
        std::cout << file.string() << " is there with these settings: nothing to resume\n";
}

void run(const TradeoffJob &job) {
    require_legal_usage(job);
    const std::vector<Configuration> plan = plan_for(job);
    require_gnuplot();
    for (const char *name : {"tradeoff.json", "tradeoff.csv", "tradeoff.svg"}) require_writable(job.file(name));
    require_writable(job.journal_file());
    require_writable(job.truth_file());

    TradeoffJournal journal(job);
    const TradeoffResult result = measure(job, plan, journal);
    if (journal.is_complete()) return print_complete(job);
    const std::string document = tradeoff_json(job, result);
    StagedFiles files;
    const auto write = [&](const char *name, const std::string &text) {
        files.write(job.file(name), [&](const auto &file) { write_text(file, text); });
    };
    write("tradeoff.svg", plot_tradeoff(job, result));
    write("tradeoff.csv", tradeoff_csv(result));
    write("tradeoff.json", document);
    files.commit();
    journal.close();

    if (job.json)
        std::cout << document;
    else
        print_tradeoff(job, result);
}

std::vector<Method> parse_methods(const std::string &text) {
    std::vector<Method> asked;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) {
        asked.push_back(parse_choice(word, methods));
        if (std::count(asked.begin(), asked.end(), asked.back()) > 1)
            throw std::invalid_argument("'" + text + "' names " + word + " twice");
    }
    if (asked.empty() || text.back() == ',') throw std::invalid_argument("'" + text + "' is not a list of methods");
    return asked;
}

void add_axes_flags(CLI::App &command, SweepAxes &axes) {
    add_parsed(command, "--methods", axes.methods, parse_methods,
               "Only these of " + words_of(methods) + " (default all)")
        ->type_name("M,...");
    const auto parse_samples = [](const std::string &text) {
        return static_cast<std::uint32_t>(parse_count(text, samples_range));
    };
    add_parsed(command, "--samples", axes.samples, parse_samples,
               "References at 1, 4, 16 ... samples per pixel, up to this many (default 65536; the geometric one to "
               "1024 at most)")
        ->type_name("N");
    add_parsed(command, "--lobes", axes.lobes, parse_lobe_counts, "Numbers of lobes (default 1,2,4,8,16)")
        ->type_name("N,...");
    add_parsed(command, "--widening-order", axes.orders, parse_widening_orders,
               "Orders of the filter's widening, 0 to 8 or auto (default all of 0 to 8)")
        ->type_name("N,...");
}

} // namespace

void add_tradeoff(CLI::App &app) {
    CLI::App *command = app.add_subcommand(
        "tradeoff", "Sweep what there is, and report error against time: tradeoff.svg, .csv and .json, truth.exr");
    const auto job = std::make_shared<TradeoffJob>();
    command->add_option("INPUT", job->input, "A MERL table (.binary), builtin:NAME or analytic:KIND,...")
        ->required()
        ->type_name("");
    command->add_option("--out", job->out, "Folder of the results")->required()->type_name("DIR");
    const auto parse_alpha = [](const std::string &text) { return parse_pair(text, alpha_range); };
    add_parsed(*command, "--alpha", job->alpha, parse_alpha, "Roughness of the displaced surface (default 0.25,0.25)")
        ->type_name("AX,AY");
    const auto parse_light = [](const std::string &text) { return parse_number(text, light_range); };
    add_parsed(*command, "--light", job->light_degrees, parse_light, "Azimuth of the light in degrees (default 0)")
        ->type_name("PHI_DEG");
    add_axes_flags(*command, job->axes);
    command->add_flag("--quick", job->quick, "Other defaults: --samples 4096, --lobes 1,8, --widening-order 0,1,3");
    add_resolution_flag(*command, job->flags);
    add_seed_flag(*command, job->flags);
    add_device_flags(*command, job->flags);
    command->add_flag("--resume", job->resume,
                      "Go on where an interrupted sweep of DIR stopped, with its finished points; other settings than "
                      "its own are refused");
    command->add_flag("--json", job->json, "Print tradeoff.json");
    command->footer(
        "Times are medians of 5 warm runs or more. Errors are against a converged reference of the measured table,\n"
        "whose own standard error is at most a tenth of what is told: what is closer is at the floor. Beside mis or\n"
        "another sampler at 4096 samples, and per-lobe or shared with 8 lobes, stand their variants: the other grades\n"
        "of arithmetic, separable masking, and each effect off in turn. Noise goes away with samples, bias does not. "
        "docs/tradeoff.md has the\n"
        "schema of what is written.");
    command->callback([job] {
        complete(job->axes, job->quick);
        job->axes.anisotropic = job->alpha.first != job->alpha.second;
        job->axes.has_double = takes_double(open_context(job->flags));
        run(*job);
    });
}

} // namespace slopemix::cli
