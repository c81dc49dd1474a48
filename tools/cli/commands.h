// The commands of slopemix. Each function adds one subcommand whose callback does the work; a callback throws
// CLI::ParseError for wrong usage (exit status 2) and any other exception for a failure (exit status 1).
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace slopemix::cli {

// All of them.
std::unique_ptr<CLI::App> make_app();

void add_info(CLI::App &app);
void add_materials(CLI::App &app);
void add_synth(CLI::App &app);
void add_fit(CLI::App &app);
void add_render(CLI::App &app);
void add_sheet(CLI::App &app);
void add_budget(CLI::App &app);
void add_tradeoff(CLI::App &app);
void add_effects(CLI::App &app);
void add_compare(CLI::App &app);
void add_bench(CLI::App &app);

} // namespace slopemix::cli
