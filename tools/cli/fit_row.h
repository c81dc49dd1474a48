// The row of a material in fits.csv and fits.json: one table of columns for both.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fit_job.h"

namespace slopemix::cli {

// Column names and values. Lists are arrays; what a material does not have, and what is no finite number, is null.
nlohmann::ordered_json fit_row(const Fitted &fitted);

// The row is of this table, fitted with these options by this version of the library.
bool is_row_of(const nlohmann::ordered_json &row, const std::string &sha256, const std::string &options);

// The row's alphas are those of these lobes.
bool is_row_of_lobes(const nlohmann::ordered_json &row, const std::vector<smx_lobe> &lobes);

// What only a table can tell of a fit; null for a density.
nlohmann::ordered_json of_table(const Fitted &fitted, double figure);

// Lines of CSV with their ends: fields quoted as in RFC 4180, lists joined by ';', null empty, numbers in the shortest
// form that reads back the same.
std::string csv_heading();
std::string csv_line(const nlohmann::ordered_json &row);

} // namespace slopemix::cli
