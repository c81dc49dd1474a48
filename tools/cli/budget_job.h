// What `slopemix budget` is asked for and what comes out.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flags.h"
#include "handles.h"
#include "sheet_plan.h"

namespace slopemix::cli {

struct BudgetJob {
    BudgetJob() { flags.target_error = 0.003; }

    std::string input;
    std::vector<std::pair<double, double>> alphas = {{0.1, 0.1}, {0.25, 0.25}, {0.5, 0.5},
                                                     {0.25, 0},  {0, 0.25},    {0, 0}};
    std::vector<double> lights = {light_degrees.begin(), light_degrees.end()};
    std::uint32_t lobes = 8;
    RenderFlags flags;
    bool json = false;
};

// relRMSE between renderings of what the filter goes through: measured table, fitted base, widened lobes.
struct BudgetErrors {
    std::optional<double> inversion; // reference of the density's table against that of the measured one; shared only
    double fit = 0.0;                // reference of the fitted base's table against that of the measured one
    double widening = 0.0;           // filtered rendering against the reference of the fitted base's table
    double total = 0.0;              // filtered rendering against the reference of the measured one
};

struct BudgetEntry {
    std::size_t alpha, light; // indices into the job's
    smx_model model;
    BudgetErrors errors;
};

struct BudgetResult {
    smx_brdf_info material;
    std::string device;
    std::vector<BudgetEntry> entries;
    std::optional<double> standard_error; // the largest of the references; without an estimate, nothing
    double seconds = 0.0;
    double build_seconds = 0.0; // of these, compiling kernels
};

BudgetResult measure_budget(const BudgetJob &job);

void print_budget_json(const BudgetJob &job, const BudgetResult &result);
void print_budget_text(const BudgetJob &job, const BudgetResult &result);

} // namespace slopemix::cli
