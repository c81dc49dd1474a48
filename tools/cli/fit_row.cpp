// To add a column, add a line to `columns`; those of --metrics are fit_metrics.h's.
#include "fit_row.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json member_of_lobes(const Fitted &fitted, double smx_lobe::*member) {
    Json values = Json::array();
    for (const smx_lobe &lobe : fitted.lobes) values.push_back(number(lobe.*member));
    return values;
}

Json only_for(smx_model model, const Fitted &fitted, const Json &value) {
    return fitted.model == model ? value : Json();
}

struct Column {
    const char *name;
    Json (*value)(const Fitted &);
};

constexpr Column columns[] = {
    {"name", [](const Fitted &f) -> Json { return to_utf8(f.name); }},
    {"input", [](const Fitted &f) -> Json { return to_utf8(f.input); }},
    {"sha256", [](const Fitted &f) -> Json { return f.sha256; }},
    {"model", [](const Fitted &f) -> Json { return word_for(f.model, models); }},
    {"lobes", [](const Fitted &f) -> Json { return f.lobes.size(); }},
    {"alpha", [](const Fitted &f) { return member_of_lobes(f, &smx_lobe::alpha); }},
    {"weight", [](const Fitted &f) { return only_for(SMX_MODEL_SHARED, f, member_of_lobes(f, &smx_lobe::weight)); }},
    {"energy", [](const Fitted &f) { return only_for(SMX_MODEL_PER_LOBE, f, member_of_lobes(f, &smx_lobe::weight)); }},
    {"f0_r", [](const Fitted &f) { return number(f.f0[0]); }},
    {"f0_g", [](const Fitted &f) { return number(f.f0[1]); }},
    {"f0_b", [](const Fitted &f) { return number(f.f0[2]); }},
    {"log_likelihood_em", [](const Fitted &f) { return number(f.report.log_likelihood_em); }},
    {"log_likelihood", [](const Fitted &f) { return number(f.report.log_likelihood); }},
    {"residual_em", [](const Fitted &f) { return number(f.report.residual_em); }},
    {"residual", [](const Fitted &f) { return number(f.report.residual); }},
    {"brdf_residual_start",
     [](const Fitted &f) { return only_for(SMX_MODEL_PER_LOBE, f, number(f.report.brdf_residual_start)); }},
    {"brdf_residual", [](const Fitted &f) { return only_for(SMX_MODEL_PER_LOBE, f, number(f.report.brdf_residual)); }},
    {"displaced_share",
     [](const Fitted &f) { return only_for(SMX_MODEL_PER_LOBE, f, number(f.report.displaced_share)); }},
    {"base_relrmse", [](const Fitted &f) { return of_table(f, f.report.base_relrmse); }},
    {"displaced_relrmse", [](const Fitted &f) { return of_table(f, f.report.displaced_relrmse); }},
    {"displaced_relrmse_shared", [](const Fitted &f) { return of_table(f, f.report.displaced_relrmse_shared); }},
    {"choice", [](const Fitted &f) -> Json { return f.report.choice; }},
    {"inversion_iterations", [](const Fitted &f) -> Json { return f.report.inversion_iterations; }},
    {"em_iterations", [](const Fitted &f) -> Json { return f.report.em_iterations; }},
    {"refine_iterations", [](const Fitted &f) -> Json { return f.report.refine_iterations; }},
    {"curve_iterations", [](const Fitted &f) -> Json { return f.report.curve_iterations; }},
    {"seconds", [](const Fitted &f) { return number(f.report.seconds); }},
    {"check_seconds", [](const Fitted &f) { return number(f.report.check_seconds); }},
    {"options", [](const Fitted &f) -> Json { return f.options; }},
    {"version", [](const Fitted &) -> Json { return smx_version(); }},
};

std::string shortest(double value) {
    std::array<char, 32> buffer;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string text_of(const Json &value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_integer()) return value.dump();
    if (value.is_number()) return shortest(value.get<double>());
    std::string list;
    for (const Json &element : value) {
        if (!list.empty()) list += ';';
        list += text_of(element);
    }
    return list;
}

std::string csv_field(const std::string &text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += c;
        quoted += c;
    }
    return quoted + '"';
}

std::vector<std::string> column_names() {
    std::vector<std::string> names;
    for (const Column &column : columns) names.emplace_back(column.name);
    Json metrics;
    put_metrics(metrics, std::nullopt);
    for (const auto &[name, none] : metrics.items()) names.push_back(name);
    return names;
}

} // namespace

Json fit_row(const Fitted &fitted) {
    Json row;
    for (const Column &column : columns) row[column.name] = column.value(fitted);
    put_metrics(row, fitted.metrics);
    return row;
}

bool is_row_of(const Json &row, const std::string &sha256, const std::string &options) {
    const auto has = [&](const char *key, const std::string &value) { return row.contains(key) && row[key] == value; };
    return has("sha256", sha256) && has("options", options) && has("version", smx_version());
}

bool is_row_of_lobes(const Json &row, const std::vector<smx_lobe> &lobes) {
    Json alphas = Json::array();
    for (const smx_lobe &lobe : lobes) alphas.push_back(number(lobe.alpha));
    return row.contains("alpha") && row["alpha"] == alphas;
}

Json of_table(const Fitted &fitted, double figure) { return is_density(fitted.input) ? Json() : number(figure); }

std::string csv_heading() {
    std::string line;
    for (const std::string &name : column_names()) line += (line.empty() ? "" : ",") + name;
    return line + '\n';
}

std::string csv_line(const Json &row) {
    std::string line;
    for (const std::string &name : column_names()) {
        if (name != columns[0].name) line += ',';
        if (row.contains(name)) line += csv_field(text_of(row[name]));
    }
    return line + '\n';
}

} // namespace slopemix::cli
