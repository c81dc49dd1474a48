// What `slopemix budget` prints: a row per roughness and model, and the means over the displaced surfaces.
#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "budget_job.h"
#include "text.h"
#include "widening_json.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

// A row of the table: some of the entries.
struct Row {
    std::vector<BudgetEntry> entries;

    // Of a list that is not empty; the inversion where its entries have one.
    BudgetErrors mean() const {
        BudgetErrors sum;
        for (const auto &[alpha, light, model, errors] : entries) {
            if (errors.inversion) sum.inversion = sum.inversion.value_or(0.0) + *errors.inversion;
            sum.fit += errors.fit;
            sum.widening += errors.widening;
            sum.total += errors.total;
        }
        const auto count = static_cast<double>(entries.size());
        if (sum.inversion) *sum.inversion /= count;
        return {sum.inversion, sum.fit / count, sum.widening / count, sum.total / count};
    }
};

Row select(const BudgetResult &result, const std::function<bool(const BudgetEntry &)> &wanted) {
    Row row;
    std::copy_if(result.entries.begin(), result.entries.end(), std::back_inserter(row.entries), wanted);
    return row;
}

Row row_at(const BudgetResult &result, std::size_t alpha, smx_model model) {
    return select(result, [=](const BudgetEntry &e) { return e.alpha == alpha && e.model == model; });
}

// Empty where no surface is displaced.
Row displaced(const BudgetJob &job, const BudgetResult &result, smx_model model) {
    return select(result,
                  [&](const BudgetEntry &e) { return e.model == model && job.alphas[e.alpha] != std::pair(0.0, 0.0); });
}

Json errors_json(const BudgetErrors &errors) {
    return {{"inversion", errors.inversion ? Json(*errors.inversion) : Json()},
            {"fit", errors.fit},
            {"widening", errors.widening},
            {"total", errors.total}};
}

Json rows_json(const BudgetJob &job, const BudgetResult &result) {
    Json rows = Json::array();
    for (std::size_t alpha = 0; alpha < job.alphas.size(); ++alpha)
        for (const auto &[word, model] : models) {
            const Row row = row_at(result, alpha, model);
            Json json = {{"alpha_x", job.alphas[alpha].first}, {"alpha_y", job.alphas[alpha].second}, {"model", word}};
            json.update(errors_json(row.mean()));
            for (const BudgetEntry &entry : row.entries) {
                Json light = {{"light_phi_deg", job.lights[entry.light]}};
                light.update(errors_json(entry.errors));
                json["lights"].push_back(light);
            }
            rows.push_back(json);
        }
    return rows;
}

Json means_json(const BudgetJob &job, const BudgetResult &result) {
    Json means = Json::array();
    for (const auto &[word, model] : models) {
        const Row row = displaced(job, result, model);
        if (row.entries.empty()) continue;
        Json json = {{"model", word}};
        json.update(errors_json(row.mean()));
        means.push_back(json);
    }
    return means;
}

TextRow text_row(const std::string &name, const char *model, const BudgetErrors &errors) {
    return {name,
            model,
            errors.inversion ? fixed(*errors.inversion, 4) : "-",
            fixed(errors.fit, 4),
            fixed(errors.widening, 4),
            fixed(errors.total, 4)};
}

} // namespace

void print_budget_json(const BudgetJob &job, const BudgetResult &result) {
    const RenderFlags &flags = job.flags;
    Json document = {{"version", SMX_VERSION_STRING}, {"input", job.input}, {"material", result.material.name}};
    document["sha256"] = result.material.sha256;
    document["lobes"] = job.lobes;
    document["widening_order"] = order_json(flags.widening_order);
    document["widening_tolerance"] = tolerance_json(flags.widening_tolerance, flags.has_auto_order());
    document["lights_deg"] = job.lights;
    document["resolution"] = {flags.resolution.width, flags.resolution.height};
    document["sampler"] = word_for(flags.sampler, samplers);
    document["grade"] = word_for(flags.grade, grades);
    document["spp"] = flags.target_error > 0.0 ? Json() : Json(flags.spp);
    document["target_error"] = flags.target_error > 0.0 ? Json(flags.target_error) : Json();
    document["scrambles"] = flags.scrambles;
    document["seed"] = flags.seed;
    document["device"] = result.device;
    document["seconds"] = result.seconds;
    document["build_seconds"] = result.build_seconds;
    document["standard_error"] = result.standard_error ? Json(*result.standard_error) : Json();
    document["rows"] = rows_json(job, result);
    document["mean"] = means_json(job, result);
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_budget_text(const BudgetJob &job, const BudgetResult &result) {
    const Resolution resolution = job.flags.resolution;
    std::cout << result.material.name << ": relRMSE, " << job.lobes << " lobes, widening order "
              << widening_text(job.flags.widening_order) << ", " << resolution.width << " x " << resolution.height
              << " pixels, references of " << sampling_text(job.flags) << "\n\n";

    std::vector<TextRow> rows = {{"alpha", "model", "inversion", "fit", "widening", "total"}};
    for (std::size_t alpha = 0; alpha < job.alphas.size(); ++alpha)
        for (const auto &[word, model] : models) {
            const auto [alpha_x, alpha_y] = job.alphas[alpha];
            rows.push_back(
                text_row(general(alpha_x, 4) + ',' + general(alpha_y, 4), word, row_at(result, alpha, model).mean()));
        }
    for (const auto &[word, model] : models) {
        const Row row = displaced(job, result, model);
        if (!row.entries.empty()) rows.push_back(text_row("displaced, mean", word, row.mean()));
    }
    print_table(std::cout, rows);

    Facts facts;
    if (result.standard_error) facts.emplace_back("largest standard error", general(*result.standard_error, 3));
    facts.emplace_back("total seconds", fixed(result.seconds, 1));
    std::cout << '\n';
    print_facts(std::cout, facts);
}

} // namespace slopemix::cli
