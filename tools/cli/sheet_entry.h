// A finished image of a sheet as an item of its journal, and back; and how its rendering went.
#pragma once

#include <nlohmann/json.hpp>

#include "sheet_job.h"

namespace slopemix::cli {

nlohmann::ordered_json report_json(const smx_render_report &report);
smx_render_report report_of(const nlohmann::ordered_json &json); // throws a JSON exception

nlohmann::ordered_json item_of(const SheetEntry &entry);

// Throws a JSON or std::invalid_argument exception for an item of another form.
SheetEntry entry_of(const nlohmann::ordered_json &item, const SheetJob &job, const SheetPlan &plan);

} // namespace slopemix::cli
