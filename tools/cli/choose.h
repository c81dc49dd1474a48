// The choice of `slopemix render` by error or by time: its flags, what is chosen from, and how it is told.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flags.h"
#include "handles.h"
#include "text.h"

namespace slopemix::cli {

struct ChooseFlags {
    double max_error = 0.0, max_seconds = 0.0; // 0: not asked for
    std::vector<std::string> materials;        // files; empty: fits are made
    bool is_asked_for() const { return max_error > 0.0 || max_seconds > 0.0; }
};

// They exclude the flags that they answer, which the command has already.
void add_choose_flags(CLI::App &command, ChooseFlags &flags);

// What there is to choose from.
struct Candidates {
    Brdf brdf; // or null
    std::vector<Material> materials;
    double fit_seconds = 0.0; // of those that were made for the choice
};

struct Chosen {
    smx_choice choice = SMX_CHOICE_INIT;
    std::vector<smx_material_info> materials;
    double fit_seconds = 0.0;
};

// A table and its fits, or files in their place; of a material file, itself and no table. `fit_flags` narrow the fits
// to the model and the number of lobes that were given.
Candidates open_candidates(const std::string &input, const ChooseFlags &flags, const FitFlags &fit_flags,
                           bool lobes_given);

Chosen choose(const Context &context, const Candidates &candidates, const smx_scene &scene,
              const smx_render_options &options, const ChooseFlags &flags);

nlohmann::ordered_json choice_json(const Chosen &chosen, const ChooseFlags &flags);
Facts choice_facts(const Chosen &chosen);

} // namespace slopemix::cli
