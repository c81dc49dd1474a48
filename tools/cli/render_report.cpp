// What `slopemix render` prints.
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "effect_flags.h"
#include "effect_report.h"
#include "render_job.h"
#include "text.h"
#include "widening_json.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

double per_sample(const smx_render_report &report) {
    return seconds_per_sample(report.seconds, report.build_seconds, report.evaluations);
}

// The grid has no estimate of its error, nor has one realisation.
bool has_error(const RenderJob &job, const smx_render_report &report) {
    return job.is_sampled() && report.standard_error >= 0.0;
}

Json configuration(const RenderJob &job, const Rendered &rendered) {
    Json json = {{"input", job.input}, {"material", rendered.name}};
    json["integrator"] = word_for(job.integrator, integrators);
    json["model"] = job.is_filtered() ? Json(word_for(rendered.model, models)) : Json();
    json["lobes"] = job.is_filtered() ? Json(rendered.lobes) : Json();
    json["widening_order"] = job.is_filtered() ? order_json(job.flags.widening_order) : Json();
    json["widening_tolerance"] =
        tolerance_json(job.flags.widening_tolerance, job.is_filtered() && job.flags.has_auto_order());
    json["widening_orders"] = job.is_filtered() ? Json(orders_of(rendered.rendering.report, rendered.lobes)) : Json();
    json["effects"] = effect_names(rendered.rendering.report.effects);
    json["effects_asked"] = effects_text(job.flags.effects);
    json["effect_tolerance"] =
        tolerance_json(job.flags.effect_tolerance, job.is_filtered() && job.flags.effects == SMX_EFFECTS_AUTO);
    json["verdicts"] = rendered.effects ? verdicts_json(*rendered.effects) : Json();
    json["lobes_shaded"] = job.is_filtered() ? Json(rendered.rendering.report.lobes) : Json();
    json["left_out"] = rendered.effects ? Json(rendered.effects->left_out) : Json();
    json["alpha_x"] = job.scene.alpha.first;
    json["alpha_y"] = job.scene.alpha.second;
    json["rho"] = job.scene.rho;
    json["mean_slope"] = {job.scene.mean_slope.first, job.scene.mean_slope.second};
    json["light"] = job.scene.uniform_light ? "uniform" : "directional";
    json["light_phi_deg"] = job.scene.uniform_light ? Json() : Json(job.scene.light_degrees);
    json["g"] = job.is_geometric() ? Json() : Json(word_for(job.flags.masking, maskings));
    json["grade"] = job.is_geometric() ? Json() : Json(word_for(job.flags.grade, grades));
    json["tile"] = job.is_geometric() ? Json(job.geometric.tile) : Json();
    json["realisations"] = job.is_geometric() ? Json(job.geometric.realisations) : Json();
    json["bounces"] = job.is_geometric() ? Json(job.geometric.bounces) : Json();
    json["resolution"] = {job.flags.resolution.width, job.flags.resolution.height};
    json["spp"] = job.is_sampled() ? Json(rendered.rendering.report.spp) : Json();
    json["target_error"] = job.flags.target_error > 0.0 ? Json(job.flags.target_error) : Json();
    json["sampler"] = job.is_reference() ? Json(word_for(job.flags.sampler, samplers)) : Json();
    json["scrambles"] = job.is_sampled() && !job.is_geometric() ? Json(job.flags.scrambles) : Json();
    json["seed"] = job.is_sampled() ? Json(job.flags.seed) : Json();
    json["lookup"] = job.is_filtered() ? Json() : Json(word_for(job.flags.lookup, lookups));
    json["device"] = rendered.device;
    json["devices"] = rendered.devices;
    return json;
}

std::string integrator_text(const RenderJob &job, const Rendered &rendered) {
    std::string text = word_for(job.integrator, integrators);
    if (job.is_filtered())
        text += std::string(", ") + word_for(rendered.model, models) + ", lobes: " + std::to_string(rendered.lobes);
    if (!job.is_sampled()) return text;
    text += ", samples per pixel: " + std::to_string(rendered.rendering.report.spp);
    if (job.is_geometric())
        text += ", realisations: " + std::to_string(job.geometric.realisations) +
                ", bounces: " + std::to_string(job.geometric.bounces);
    return text;
}

} // namespace

void print_json(const RenderJob &job, const Rendered &rendered) {
    const smx_render_report &report = rendered.rendering.report;
    Json document = {{"version", SMX_VERSION_STRING}};
    document.update(configuration(job, rendered));
    document["choice"] = rendered.chosen ? choice_json(*rendered.chosen, job.choose) : Json();
    document["out"] = job.out;
    document["png"] = job.png ? Json(job.png_file().string()) : Json();
    document["exposure"] = job.png ? Json(rendered.exposure) : Json();
    document["standard_error"] = has_error(job, report) ? Json(report.standard_error) : Json();
    document["unsettled"] = job.is_filtered() ? Json(report.unsettled) : Json();
    document["seconds"] = report.seconds;
    document["kernel_seconds"] = report.kernel_seconds;
    document["build_seconds"] = report.build_seconds;
    document["evaluations"] = report.evaluations;
    document["seconds_per_sample"] = per_sample(report);
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_text(const RenderJob &job, const Rendered &rendered) {
    const smx_render_report &report = rendered.rendering.report;
    Facts facts = {{"material", rendered.name}};
    facts.emplace_back("integrator", integrator_text(job, rendered));
    if (job.is_filtered()) {
        std::string orders;
        for (int order : orders_of(report, rendered.lobes)) orders += ' ' + std::to_string(order);
        facts.emplace_back("widening", widening_text(job.flags.widening_order) + ", by lobe:" + orders);
    }
    if (rendered.chosen)
        for (const auto &fact : choice_facts(*rendered.chosen)) facts.push_back(fact);
    facts.emplace_back("effects", effects_text(report.effects));
    if (rendered.effects) add_left_out(facts, *rendered.effects, rendered.lobes);
    if (has_error(job, report)) facts.emplace_back("standard error", general(report.standard_error, 3));
    facts.emplace_back("device", rendered.device);
    facts.emplace_back("seconds", fixed(report.seconds, 3) + " (on the device " + fixed(report.kernel_seconds, 3) +
                                      ", compiling kernels " + fixed(report.build_seconds, 3) + ")");
    facts.emplace_back("per sample",
                       general(1e9 * per_sample(report), 3) + " ns, of " + std::to_string(report.evaluations));
    facts.emplace_back("written", job.out);
    if (job.png) facts.emplace_back("", job.png_file().string() + " at exposure " + general(rendered.exposure, 4));
    print_facts(std::cout, facts);
}

} // namespace slopemix::cli
