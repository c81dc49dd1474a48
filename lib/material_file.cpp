#include "material_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "atomic_file.h"
#include "error.h"
#include "fit_report_file.h"
#include "json_reader.h"
#include "read_file.h"

namespace smx {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char *format_name = "slopemix-material";
constexpr unsigned format_version = 2;
constexpr std::size_t max_bytes = std::size_t{64} << 20; // 64 lobes of 4096 knots take half of it
constexpr int max_depth = 16;                            // ours are 6 deep; a bracket may cost 60 times its byte

ordered_json curves_to_json(const FresnelCurves &curves) {
    ordered_json out;
    for (std::size_t c = 0; c < 3; ++c) out[channel_names[c]] = curves[c];
    return out;
}

ordered_json to_json(const Material &m) {
    ordered_json lobes = ordered_json::array(), fresnel = ordered_json::array();
    for (const Lobe &lobe : m.lobes) lobes.push_back({{"weight", lobe.weight}, {"alpha", lobe.alpha}});
    for (const FresnelCurves &curves : m.fresnel) fresnel.push_back(curves_to_json(curves));
    return {{"format", format_name},
            {"version", format_version},
            {"name", m.name},
            {"source", {{"name", m.source}, {"sha256", m.sha256}}},
            {"model", model_name(m.model)},
            {"lobes", lobes},
            {"theta_d", m.theta_d},
            {"fresnel", fresnel},
            {"fit", report_to_json(m.report)}};
}

std::vector<Lobe> lobes_from_json(const JsonReader &in) {
    std::vector<Lobe> lobes;
    const std::size_t count = in.array_size();
    if (count < 1 || count > max_lobes) in.refuse(text("must hold 1..", max_lobes, " lobes, not ", count));
    for (std::size_t k = 0; k < count; ++k) {
        JsonReader lobe = in.element(k);
        lobes.push_back({lobe.member("weight").number(), lobe.member("alpha").number()});
        lobe.finish();
    }
    return lobes;
}

std::vector<FresnelCurves> fresnel_from_json(const JsonReader &in) {
    std::vector<FresnelCurves> sets;
    for (std::size_t set = 0; set < in.array_size(); ++set) {
        JsonReader curves = in.element(set);
        sets.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) sets.back()[c] = numbers_from_json(curves.member(channel_names[c]));
        curves.finish();
    }
    return sets;
}

Model model_from_json(const JsonReader &in) {
    for (Model model : {Model::Shared, Model::PerLobe})
        if (in.string() == model_name(model)) return model;
    in.refuse(text("is \"", in.string(), "\"; it must be \"shared\" or \"per-lobe\""));
}

Material from_json(const json &document) {
    JsonReader in(document, "$");
    if (in.member("format").string() != format_name) in.member("format").refuse(text("must be \"", format_name, "\""));
    const unsigned version = in.member("version").count();
    if (version != format_version)
        in.member("version").refuse(text("is ", version, "; this library reads ", format_version));

    Material m;
    m.name = in.member("name").string();
    JsonReader source = in.member("source");
    m.source = source.member("name").string();
    m.sha256 = source.member("sha256").string();
    source.finish();
    m.model = model_from_json(in.member("model"));
    m.lobes = lobes_from_json(in.member("lobes"));
    m.theta_d = numbers_from_json(in.member("theta_d"));
    m.fresnel = fresnel_from_json(in.member("fresnel"));
    m.report = report_from_json(in.member("fit"));
    in.finish();
    return m;
}

// Ranges, and what the rest of the library takes for granted of a material: the lobes' order and the weights' sum.
void check_values(const Material &m) {
    try {
        validate(m);
    } catch (const Error &e) {
        fail(Fault::BadFormat, "$.", e.what());
    }
    double total = 0.0;
    for (const Lobe &lobe : m.lobes) total += lobe.weight;
    if (std::abs(total - 1.0) > 1e-9) fail(Fault::BadFormat, "$.lobes: the weights sum to ", total, ", not 1");
    const Deviations &deviations = m.report.deviations;
    if (deviations.alpha.size() != deviations.curves.size() ||
        (!deviations.alpha.empty() && deviations.alpha.size() != m.lobes.size()))
        fail(Fault::BadFormat, "$.fit.deviations: must be of ", m.lobes.size(), " lobes, or empty");
    for (const auto &lobe : deviations.curves)
        for (const std::vector<double> &channel : lobe)
            if (channel.size() != curve_coefficients)
                fail(Fault::BadFormat, "$.fit.deviations.curves: a channel has ", curve_coefficients, " values, not ",
                     channel.size());
    const std::size_t angles = m.report.albedo.theta_o.size();
    if (angles != 0 && angles != albedo_angles)
        fail(Fault::BadFormat, "$.fit.albedo.theta_o: must hold ", albedo_angles, " angles or none, not ", angles);
    for (std::size_t k = 1; k < m.lobes.size(); ++k)
        if (m.lobes[k].alpha < m.lobes[k - 1].alpha)
            fail(Fault::BadFormat, "$.lobes[", k, "].alpha is ", m.lobes[k].alpha, ", below the lobe before it");
}

json parse(const std::string &bytes) {
    return json::parse(bytes, [](int depth, json::parse_event_t, json &) {
        if (depth > max_depth) fail(Fault::BadFormat, "it is nested more than ", max_depth, " deep");
        return true;
    });
}

} // namespace

Material load_material(const std::string &path) {
    const std::string bytes = read_file(path, max_bytes);
    try {
        Material material = from_json(parse(bytes));
        check_values(material);
        return material;
    } catch (const json::exception &e) {
        fail(Fault::BadFormat, path, ": ", e.what());
    } catch (const Error &e) {
        fail(e.fault(), path, ": ", e.what());
    }
}

void save_material(const Material &material, const std::string &path) {
    // A name that is no UTF-8, of a file named so, keeps its place with replacement characters.
    const std::string text = to_json(material).dump(2, ' ', false, ordered_json::error_handler_t::replace);
    write_atomically(path, text + "\n");
}

} // namespace smx
