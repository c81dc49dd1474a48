#include "fit_compare.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "brdf_metrics.h"
#include "handles.h"
#include "input.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

void print_json(const std::string &other, const std::string &source, const smx_brdf_errors &errors) {
    Json document = {{"version", SMX_VERSION_STRING}, {"input", source}, {"compare", other}};
    for (const BrdfMetric &metric : brdf_metrics) document[metric.name] = errors.*metric.all;
    for (const BrdfMetric &metric : brdf_metrics) document[std::string(metric.name) + "_80"] = errors.*metric.within_80;
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_text(const smx_brdf_errors &errors) {
    std::vector<TextRow> rows = {{"", "all directions", "up to 80 degrees"}};
    for (const BrdfMetric &metric : brdf_metrics)
        rows.push_back({metric.formula, general(errors.*metric.all), general(errors.*metric.within_80)});
    print_table(std::cout, rows);
    std::cout << brdf_metrics_note << '\n';
}

} // namespace

void compare_tables(const std::string &other, const std::string &source, bool json) {
    const Brdf reference = open_brdf(source), brdf = open_brdf(other);
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    check(smx_brdf_compare(brdf.get(), reference.get(), &errors));
    if (json)
        print_json(other, source, errors);
    else
        print_text(errors);
}

} // namespace slopemix::cli
