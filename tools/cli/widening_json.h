// The widening of filtered images in JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "slopemix.h"

namespace slopemix::cli {

// A number or "auto".
inline nlohmann::ordered_json order_json(std::int32_t order) {
    using Json = nlohmann::ordered_json;
    return order == SMX_WIDENING_AUTO ? Json("auto") : Json(order);
}

// null where no order is auto: no other knows a tolerance.
inline nlohmann::ordered_json tolerance_json(double tolerance, bool is_auto) {
    using Json = nlohmann::ordered_json;
    return is_auto ? Json(tolerance) : Json();
}

// Of a filtered image, by lobe.
inline std::vector<int> orders_of(const smx_render_report &report, std::uint32_t lobes) {
    return {report.widening_orders, report.widening_orders + lobes};
}

} // namespace slopemix::cli
