#include "sheet_entry.h"

#include <algorithm>
#include <iterator>

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

// Without the zeros behind the last lobe.
Json orders_json(const smx_render_report &report) {
    const auto is_lobe = [](std::uint8_t order) { return order != 0; };
    const auto end =
        std::find_if(std::rbegin(report.widening_orders), std::rend(report.widening_orders), is_lobe).base();
    return std::vector<std::uint8_t>(std::begin(report.widening_orders), end);
}

} // namespace

Json report_json(const smx_render_report &report) {
    return {{"seconds", report.seconds},
            {"kernel_seconds", report.kernel_seconds},
            {"build_seconds", report.build_seconds},
            {"evaluations", report.evaluations},
            {"spp", report.spp},
            {"standard_error", report.standard_error},
            {"widening_orders", orders_json(report)},
            {"unsettled", report.unsettled}};
}

smx_render_report report_of(const Json &json) {
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    json.at("seconds").get_to(report.seconds);
    json.at("kernel_seconds").get_to(report.kernel_seconds);
    json.at("build_seconds").get_to(report.build_seconds);
    json.at("evaluations").get_to(report.evaluations);
    json.at("spp").get_to(report.spp);
    json.at("standard_error").get_to(report.standard_error);
    const auto orders = json.at("widening_orders").get<std::vector<std::uint8_t>>();
    std::copy_n(orders.begin(), std::min(orders.size(), std::size(report.widening_orders)), report.widening_orders);
    json.at("unsettled").get_to(report.unsettled);
    return report;
}

Json item_of(const SheetEntry &entry) {
    return {{"id", to_string(entry.image.id)}, {"sha256", entry.sha256}, {"report", report_json(entry.report)}};
}

SheetEntry entry_of(const Json &item, const SheetJob &job, const SheetPlan &plan) {
    const ImageId id = parse_image_ids(item.at("id").get<std::string>()).at(0);
    return {plan.image(id), job.image_file(id), report_of(item.at("report")), item.at("sha256")};
}

} // namespace slopemix::cli
