// What `fit` is asked to do, and what it found out about a material.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit_metrics.h"
#include "flags.h"
#include "handles.h"
#include "input.h"

namespace slopemix::cli {

struct FitJob {
    std::vector<std::string> inputs;
    std::filesystem::path out;
    std::string compare; // a table; empty: fit
    FitFlags fit;
    std::size_t jobs = 1; // materials at the same time
    bool refit = false;   // also what is up to date
    bool resume = false;  // the same as not refit, said aloud
    bool metrics = false; // errors in BRDF space
    bool plot = false;
    bool json = false;

    std::filesystem::path file_for(const std::string &input) const { return out / (name_of(input) + ".json"); }
    std::filesystem::path plot_for(const std::string &input) const { return out / (name_of(input) + ".svg"); }
};

// A material that was fitted, now or by an earlier run.
struct Fitted {
    std::string input, name, file;
    std::string options; // of the fit, options_text()
    std::string sha256;  // of the table or the density's file
    smx_model model;
    std::vector<smx_lobe> lobes;
    std::array<double, 3> f0; // at normal incidence; per-lobe: the sum over the lobes
    smx_fit_report report;
    bool up_to_date = false; // an earlier run's
    std::optional<FitMetrics> metrics;
};

// What came of one input: a material, an error, or both where the material is there and its picture is not.
struct FitOutcome {
    std::size_t index; // of the input
    std::optional<Fitted> fitted;
    std::string error;      // empty: none
    bool cancelled = false; // before all was done that was asked for
};

} // namespace slopemix::cli
