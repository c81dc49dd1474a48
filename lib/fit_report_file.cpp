#include "fit_report_file.h"

namespace smx {

using nlohmann::ordered_json;

namespace {

// A deviation, or null for a parameter that was held.
ordered_json deviations_to_json(const std::vector<double> &deviations) {
    ordered_json out = ordered_json::array();
    for (double value : deviations) out.push_back(value == Deviations::held ? ordered_json() : ordered_json(value));
    return out;
}

std::vector<double> deviations_from_json(const JsonReader &in) {
    std::vector<double> deviations;
    for (std::size_t k = 0; k < in.array_size(); ++k) {
        const JsonReader value = in.element(k);
        deviations.push_back(value.is_null() ? Deviations::held : value.number());
    }
    return deviations;
}

ordered_json to_json(const Deviations &deviations) {
    ordered_json curves = ordered_json::array();
    for (const auto &lobe : deviations.curves) {
        ordered_json set;
        for (std::size_t c = 0; c < 3; ++c) set[channel_names[c]] = deviations_to_json(lobe[c]);
        curves.push_back(set);
    }
    return {{"alpha", deviations_to_json(deviations.alpha)}, {"curves", curves}};
}

Deviations read_deviations(JsonReader in) {
    Deviations deviations;
    deviations.alpha = deviations_from_json(in.member("alpha"));
    const JsonReader curves = in.member("curves");
    for (std::size_t k = 0; k < curves.array_size(); ++k) {
        JsonReader set = curves.element(k);
        auto &lobe = deviations.curves.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) lobe[c] = deviations_from_json(set.member(channel_names[c]));
        set.finish();
    }
    in.finish();
    return deviations;
}

ordered_json by_channel(const std::vector<Rgb> &values) {
    ordered_json out;
    for (std::size_t c = 0; c < 3; ++c) {
        out[channel_names[c]] = ordered_json::array();
        for (const Rgb &value : values) out[channel_names[c]].push_back(value[c]);
    }
    return out;
}

std::vector<Rgb> read_by_channel(JsonReader in, std::size_t count) {
    std::vector<Rgb> values(count);
    for (std::size_t c = 0; c < 3; ++c) {
        const JsonReader channel = in.member(channel_names[c]);
        const std::vector<double> numbers = numbers_from_json(channel);
        if (numbers.size() != count) channel.refuse("must be as long as theta_o");
        for (std::size_t t = 0; t < count; ++t) values[t][c] = numbers[t];
    }
    in.finish();
    return values;
}

ordered_json to_json(const AlbedoReport &albedo) {
    return {{"theta_o", albedo.theta_o}, {"table", by_channel(albedo.table)}, {"fit", by_channel(albedo.fit)}};
}

AlbedoReport read_albedo(JsonReader in) {
    AlbedoReport albedo;
    albedo.theta_o = numbers_from_json(in.member("theta_o"));
    albedo.table = read_by_channel(in.member("table"), albedo.theta_o.size());
    albedo.fit = read_by_channel(in.member("fit"), albedo.theta_o.size());
    in.finish();
    return albedo;
}

} // namespace

std::vector<double> numbers_from_json(const JsonReader &in) {
    std::vector<double> numbers;
    for (std::size_t k = 0; k < in.array_size(); ++k) numbers.push_back(in.element(k).number());
    return numbers;
}

ordered_json report_to_json(const FitReport &r) {
    return {{"inversion_iterations", r.inversion_iterations},
            {"em_iterations", r.em_iterations},
            {"refine_iterations", r.refine_iterations},
            {"log_likelihood_em", r.log_likelihood_em},
            {"log_likelihood", r.log_likelihood},
            {"residual_em", r.residual_em},
            {"residual", r.residual},
            {"refine_message", r.refine_message},
            {"curve_iterations", r.curve_iterations},
            {"brdf_residual_start", r.brdf_residual_start},
            {"brdf_residual", r.brdf_residual},
            {"displaced_share", r.displaced_share},
            {"curve_message", r.curve_message},
            {"base_relrmse", r.base_relrmse},
            {"displaced_relrmse", r.displaced_relrmse},
            {"displaced_relrmse_shared", r.displaced_relrmse_shared},
            {"choice", r.choice},
            {"seconds", r.seconds},
            {"check_seconds", r.check_seconds},
            {"deviations", to_json(r.deviations)},
            {"albedo", to_json(r.albedo)}};
}

FitReport report_from_json(JsonReader in) {
    FitReport r;
    r.inversion_iterations = in.member("inversion_iterations").count();
    r.em_iterations = in.member("em_iterations").count();
    r.refine_iterations = in.member("refine_iterations").count();
    r.log_likelihood_em = in.member("log_likelihood_em").number();
    r.log_likelihood = in.member("log_likelihood").number();
    r.residual_em = in.member("residual_em").number();
    r.residual = in.member("residual").number();
    r.refine_message = in.member("refine_message").string();
    r.curve_iterations = in.member("curve_iterations").count();
    r.brdf_residual_start = in.member("brdf_residual_start").number();
    r.brdf_residual = in.member("brdf_residual").number();
    r.displaced_share = in.member("displaced_share").number();
    r.curve_message = in.member("curve_message").string();
    r.base_relrmse = in.member("base_relrmse").number();
    r.displaced_relrmse = in.member("displaced_relrmse").number();
    r.displaced_relrmse_shared = in.member("displaced_relrmse_shared").number();
    r.choice = in.member("choice").string();
    r.seconds = in.member("seconds").number();
    r.check_seconds = in.member("check_seconds").number();
    r.deviations = read_deviations(in.member("deviations"));
    r.albedo = read_albedo(in.member("albedo"));
    in.finish();
    return r;
}

} // namespace smx
