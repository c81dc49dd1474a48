// sheet.json (schema below, in the order of its keys) and the summary table.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "exposure.h"
#include "sheet_job.h"
#include "text.h"
#include "widening_json.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr int schema_version = 1;

// The errors of all filtered images of one fit by one widening order.
struct FitSummary {
    smx_model model;
    std::uint32_t lobes;
    std::int32_t order;
    std::size_t images = 0;
    double mean_relrmse = 0.0, mean_bias = 0.0;
    const SheetEntry *worst = nullptr;
};

auto key_of(const SheetImage &image) { return std::tuple(image.model, image.lobes, image.widening_order); }

std::vector<FitSummary> summaries(const SheetResult &result) {
    std::map<std::tuple<smx_model, std::uint32_t, std::int32_t>, FitSummary> by_key;
    for (const SheetEntry &entry : result.entries) {
        if (!entry.errors) continue;
        const SheetImage &image = entry.image;
        FitSummary &summary =
            by_key.try_emplace(key_of(image), FitSummary{image.model, image.lobes, image.widening_order}).first->second;
        ++summary.images;
        summary.mean_relrmse += entry.errors->relrmse;
        summary.mean_bias += entry.errors->bias;
        if (!summary.worst || entry.errors->relrmse > summary.worst->errors->relrmse) summary.worst = &entry;
    }
    std::vector<FitSummary> all;
    for (auto &[key, summary] : by_key) {
        summary.mean_relrmse /= static_cast<double>(summary.images);
        summary.mean_bias /= static_cast<double>(summary.images);
        all.push_back(summary);
    }
    return all;
}

const char *integrator_of(Role role) {
    switch (role) {
        case Role::geometry:
            return "geometry";
        case Role::reference:
            return "reference";
        case Role::filtered:
            return "filtered";
    }
    return "unknown";
}

// Of a filtered image, whose material is always fitted; null of others.
const SheetFit *fit_of(const SheetImage &image, const SheetResult &result) {
    const auto is_its = [&](const SheetFit &fit) { return fit.model == image.model && fit.lobes == image.lobes; };
    const auto found = std::find_if(result.fits.begin(), result.fits.end(), is_its);
    return image.role == Role::filtered && found != result.fits.end() ? &*found : nullptr;
}

Json summary_json(const SheetResult &result) {
    Json json = Json::array();
    for (const FitSummary &summary : summaries(result))
        json.push_back({{"model", word_for(summary.model, models)},
                        {"lobes", summary.lobes},
                        {"widening_order", order_json(summary.order)},
                        {"images", summary.images},
                        {"mean_relrmse", summary.mean_relrmse},
                        {"mean_bias", summary.mean_bias},
                        {"worst_relrmse", summary.worst->errors->relrmse},
                        {"worst_image", to_string(summary.worst->image.id)}});
    return json;
}

Json orders_json(const std::vector<std::int32_t> &orders) {
    Json json = Json::array();
    for (const std::int32_t order : orders) json.push_back(order_json(order));
    return json;
}

Json only_json(const SheetJob &job) {
    if (job.only.empty()) return {};
    Json ids = Json::array();
    for (const ImageId &id : std::set(job.only.begin(), job.only.end())) ids.push_back(to_string(id));
    return ids;
}

Json settings_json(const SheetJob &job) {
    const RenderFlags &flags = job.flags;
    return {{"model", job.per_lobe_orders().empty() ? "shared" : "both"},
            {"resolution", {flags.resolution.width, flags.resolution.height}},
            {"radii", job.radii},
            {"lobes", job.lobes},
            {"per_lobe_orders", orders_json(job.per_lobe_orders())},
            {"widening_tolerance", tolerance_json(flags.widening_tolerance, job.has_auto_order())},
            {"spp", flags.target_error > 0.0 ? Json() : Json(flags.spp)},
            {"target_error", flags.target_error > 0.0 ? Json(flags.target_error) : Json()},
            {"sampler", word_for(flags.sampler, samplers)},
            {"scrambles", flags.scrambles},
            {"seed", flags.seed},
            {"lookup", word_for(flags.lookup, lookups)},
            {"g", word_for(flags.masking, maskings)},
            {"grade", word_for(flags.grade, grades)}};
}

Json exposures_json(const SheetResult &result) {
    Json exposures = Json::array();
    for (std::size_t light = 0; light < light_degrees.size(); ++light)
        if (result.light_bright[light] > 0.0)
            exposures.push_back(
                {{"light_phi_deg", light_degrees[light]}, {"exposure", exposure_for(result.light_bright[light])}});
    return exposures;
}

} // namespace

Json sheet_settings(const SheetJob &job, const smx_brdf_info &material) {
    Json settings = {{"version", SMX_VERSION_STRING}, {"sha256", material.sha256}};
    settings.update(settings_json(job));
    return settings;
}

Json image_json(const SheetEntry &entry, const SheetFit *fit) {
    const SheetImage &image = entry.image;
    const bool filtered = image.role == Role::filtered;
    Json json = {{"id", to_string(image.id)}, {"column", image.id.column}, {"integrator", integrator_of(image.role)}};
    json["sha256"] = entry.sha256;
    json["alpha_x"] = image.alpha_x;
    json["alpha_y"] = image.alpha_y;
    json["light_phi_deg"] = image.has_light() ? Json(light_degrees[image.light]) : Json();
    json["lobes"] = filtered ? Json(image.lobes) : Json();
    json["model"] = filtered ? Json(word_for(image.model, models)) : Json();
    json["widening_order"] = filtered ? order_json(image.widening_order) : Json();
    json["widening_orders"] = filtered ? Json(orders_of(entry.report, fit->fitted_lobes)) : Json();
    json["unsettled"] = filtered ? Json(entry.report.unsettled) : Json();
    const bool reference = image.role == Role::reference;
    json["spp"] = reference ? Json(entry.report.spp) : Json();
    json["standard_error"] =
        reference && entry.report.standard_error >= 0.0 ? Json(entry.report.standard_error) : Json();
    json["seconds"] = entry.report.seconds;
    if (entry.errors) {
        json["relrmse"] = entry.errors->relrmse;
        json["max_error"] = entry.errors->max_error;
        json["bias"] = entry.errors->bias;
    }
    return json;
}

Json fit_json(const SheetFit &fit) {
    return {{"model", word_for(fit.model, models)},
            {"lobes", fit.lobes},
            {"fitted_lobes", fit.fitted_lobes},
            {"log_likelihood", fit.log_likelihood},
            {"residual", fit.residual},
            {"seconds", fit.seconds},
            {"material_sha256", fit.material_sha256.empty() ? Json() : Json(fit.material_sha256)}};
}

std::string sheet_json(const SheetJob &job, const SheetResult &result) {
    Json document = {{"schema", schema_version}};
    document["material"] = result.material.name;
    document["source"] = result.material.source;
    document.update(sheet_settings(job, result.material));
    document["device"] = result.device;
    document["only"] = only_json(job);
    document["kept_images"] = result.kept_images;
    document["total_seconds"] = result.total_seconds;
    document["build_seconds"] = result.build_seconds;
    document["reference_seconds"] = result.reference_seconds();
    document["seconds_per_reference_sample"] = result.seconds_per_reference_sample();
    document["fits"] = Json::array();
    for (const SheetFit &fit : result.fits) document["fits"].push_back(fit_json(fit));
    document["summary"] = summary_json(result);
    document["exposures"] = exposures_json(result);
    document["images"] = Json::array();
    for (const SheetEntry &entry : result.entries)
        document["images"].push_back(image_json(entry, fit_of(entry.image, result)));
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

double SheetResult::reference_seconds() const {
    double seconds = 0.0;
    for (const SheetEntry &entry : entries)
        if (entry.image.role == Role::reference) seconds += entry.report.seconds - entry.report.build_seconds;
    return seconds;
}

double SheetResult::seconds_per_reference_sample() const {
    double samples = 0.0;
    for (const SheetEntry &entry : entries)
        if (entry.image.role == Role::reference) samples += static_cast<double>(entry.report.evaluations);
    return samples > 0.0 ? reference_seconds() / samples : 0.0;
}

void print_summary(const SheetJob &job, const SheetResult &result) {
    const RenderFlags &flags = job.flags;
    std::cout << result.material.name << ": " << result.entries.size() << " images of " << flags.resolution.width
              << " x " << flags.resolution.height << ", references of " << sampling_text(flags) << ", in " << job.out
              << "\n\n";

    std::vector<TextRow> rows = {{"model", "N", "order", "images", "mean relRMSE", "worst relRMSE", "in", "mean bias"}};
    for (const FitSummary &summary : summaries(result))
        rows.push_back({word_for(summary.model, models), std::to_string(summary.lobes), widening_text(summary.order),
                        std::to_string(summary.images), fixed(summary.mean_relrmse, 4),
                        fixed(summary.worst->errors->relrmse, 4), to_string(summary.worst->image.id),
                        fixed(summary.mean_bias, 4)});
    if (rows.size() > 1) {
        print_table(std::cout, rows);
        std::cout << '\n';
    }

    Facts facts = {{"total seconds",
                    fixed(result.total_seconds, 2) + " (compiling kernels " + fixed(result.build_seconds, 2) + ")"}};
    if (result.seconds_per_reference_sample() > 0.0)
        facts.emplace_back("seconds per reference sample", general(result.seconds_per_reference_sample(), 3));
    if (result.kept_images > 0) facts.emplace_back("images of earlier runs", std::to_string(result.kept_images));
    facts.emplace_back("contact sheet", job.file("sheet.png").string());
    print_facts(std::cout, facts);
}

} // namespace slopemix::cli
