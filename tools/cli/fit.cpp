// slopemix fit: measured tables to material files.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.h"
#include "fit_compare.h"
#include "flags.h"
#include "input.h"
#include "output.h"
#include "progress.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

struct FitJob {
    std::vector<std::string> inputs;
    std::string out, compare;
    FitFlags fit;
    bool json = false;

    std::string file_for(const std::string &input) const {
        return (std::filesystem::path(out) / (name_of(input) + ".json")).string();
    }
};

struct Fitted {
    std::string input, file;
    smx_model model;
    std::vector<smx_lobe> lobes;
    smx_fit_report report;
};

void refuse_equal_names(const FitJob &job) {
    std::map<std::string, std::string> input_of_file;
    for (const std::string &input : job.inputs) {
        const auto [other, is_new] = input_of_file.emplace(job.file_for(input), input);
        if (!is_new)
            throw CLI::ValidationError(
                "INPUT", "'" + other->second + "' and '" + input + "' would both be written to " + other->first);
    }
}

std::vector<smx_lobe> lobes_of(const Material &material) {
    std::vector<smx_lobe> lobes(info_of(material).lobes);
    check(smx_material_get_lobes(material.get(), lobes.data(), lobes.size()));
    return lobes;
}

Fitted fit_one(const FitJob &job, const std::string &input) {
    const Material material = fit(open_density(input), fit_flags_for(input, job.fit));
    const std::string file = job.file_for(input);
    make_folder_of(file);
    check(smx_material_save(material.get(), file.c_str()));
    return {input, file, info_of(material).model, lobes_of(material), report_of(material)};
}

constexpr const char *density_note = "a slope density has no BRDF to fit other curves to: F = 1";

Json to_json(const Fitted &fitted) {
    const smx_fit_report &report = fitted.report;
    const bool per_lobe = fitted.model == SMX_MODEL_PER_LOBE;
    Json lobes = Json::array();
    for (const smx_lobe &lobe : fitted.lobes) lobes.push_back({{"weight", lobe.weight}, {"alpha", lobe.alpha}});
    return {{"input", fitted.input},
            {"name", name_of(fitted.input)},
            {"file", fitted.file},
            {"model", word_for(fitted.model, models)},
            {"model_note", is_density(fitted.input) ? Json(density_note) : Json()},
            {"lobes", lobes},
            {"log_likelihood_em", report.log_likelihood_em},
            {"log_likelihood", report.log_likelihood},
            {"residual_em", report.residual_em},
            {"residual", report.residual},
            {"iterations",
             {{"inversion", report.inversion_iterations},
              {"em", report.em_iterations},
              {"refine", report.refine_iterations},
              {"curves", report.curve_iterations}}},
            {"brdf_residual_start", per_lobe ? Json(report.brdf_residual_start) : Json()},
            {"brdf_residual", per_lobe ? Json(report.brdf_residual) : Json()},
            {"refine_message", report.refine_message},
            {"curve_message", report.curve_message},
            {"seconds", report.seconds}};
}

std::string refined(double before, double after) {
    return fixed(after, 6) + " (before the refinement " + fixed(before, 6) + ")";
}

void print_text(const Fitted &fitted) {
    const smx_fit_report &report = fitted.report;
    std::cout << name_of(fitted.input) << " -> " << fitted.file << ", " << word_for(fitted.model, models);
    if (is_density(fitted.input)) std::cout << " (" << density_note << ')';
    std::cout << '\n';
    std::vector<TextRow> rows = {{"  lobe", "weight", "alpha"}};
    for (const smx_lobe &lobe : fitted.lobes)
        rows.push_back({std::to_string(rows.size()), fixed(lobe.weight, 6), general(lobe.alpha, 5)});
    print_table(std::cout, rows);
    Facts facts = {{"  log likelihood", refined(report.log_likelihood_em, report.log_likelihood)},
                   {"  residual", refined(report.residual_em, report.residual)}};
    std::string iterations = std::to_string(report.inversion_iterations) + " inversion, " +
                             std::to_string(report.em_iterations) + " EM, " + std::to_string(report.refine_iterations) +
                             " refinement";
    if (fitted.model == SMX_MODEL_PER_LOBE) {
        facts.emplace_back("  BRDF residual", refined(report.brdf_residual_start, report.brdf_residual));
        iterations += ", " + std::to_string(report.curve_iterations) + " curves";
    }
    facts.emplace_back("  iterations", iterations);
    facts.emplace_back("  seconds", fixed(report.seconds, 3));
    print_facts(std::cout, facts);
    std::cout << std::endl;
}

// Fits every input, also after one that fails.
class FitRun {
  public:
    explicit FitRun(const FitJob &job) : job_(job), progress_(static_cast<double>(job.inputs.size())) {}

    void process(const std::string &input) {
        progress_.start("fitting " + name_of(input), 1.0);
        try {
            report(fit_one(job_, input));
        } catch (const Cancelled &) {
            throw;
        } catch (const CommandError &error) {
            report_failure(input, error.what());
        }
        progress_.finish();
    }

    const Json &materials() const { return materials_; }
    const Json &failures() const { return failures_; }

  private:
    void report(const Fitted &fitted) {
        progress_.clear();
        materials_.push_back(to_json(fitted));
        if (!job_.json) print_text(fitted);
    }

    void report_failure(const std::string &input, const std::string &message) {
        progress_.clear();
        failures_.push_back({{"input", input}, {"error", message}});
        std::cerr << "slopemix: " << message << '\n';
    }

    const FitJob &job_;
    Progress progress_;
    Json materials_ = Json::array(), failures_ = Json::array();
};

void run(const FitJob &job) {
    if (!job.compare.empty()) {
        if (job.inputs.size() != 1) throw CLI::ValidationError("--compare", "it takes one INPUT, the source");
        return compare_tables(job.compare, job.inputs[0], job.json);
    }
    if (job.out.empty()) throw CLI::RequiredError("--out");
    refuse_equal_names(job);
    for (const std::string &input : job.inputs) fit_flags_for(input, job.fit); // wrong usage is found before any work
    for (const std::string &input : job.inputs) require_writable(job.file_for(input));

    FitRun fits(job);
    for (const std::string &input : job.inputs) fits.process(input);
    if (job.json) {
        const Json document = {
            {"version", SMX_VERSION_STRING}, {"materials", fits.materials()}, {"failures", fits.failures()}};
        std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    }
    if (!fits.failures().empty())
        throw CommandError(std::to_string(fits.failures().size()) + " of " + std::to_string(job.inputs.size()) +
                           " inputs failed");
}

} // namespace

void add_fit(CLI::App &app) {
    CLI::App *command =
        app.add_subcommand("fit", "Fit measured tables or slope densities and write material files, DIR/<name>.json");
    const auto job = std::make_shared<FitJob>();
    command
        ->add_option("INPUT", job->inputs,
                     "MERL tables (.binary), builtin:NAME, analytic:KIND,... (see synth) or density:FILE.csv")
        ->required()
        ->type_name("");
    CLI::Option *out = command->add_option("--out", job->out, "Folder of the material files")->type_name("DIR");
    command
        ->add_option("--compare", job->compare,
                     "Fit nothing: print the errors of this table against INPUT, its source, in BRDF space")
        ->excludes(out)
        ->type_name("OTHER.binary");
    add_fit_flags(*command, job->fit);
    command->add_flag("--json", job->json, "Print JSON");
    command->callback([job] { run(*job); });
}

} // namespace slopemix::cli
