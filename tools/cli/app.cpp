// The command line as a whole: what the command parses, and its manual and completions are made from.
#include <CLI/CLI.hpp>
#include <string>

#include "commands.h"
#include "slopemix.h"

namespace slopemix::cli {

std::unique_ptr<CLI::App> make_app() {
    auto app = std::make_unique<CLI::App>("How a measured material looks on a surface that is rough below the pixel.",
                                          "slopemix");
    app->set_version_flag("--version", std::string("slopemix ") + smx_version());
    app->require_subcommand(1);
    add_info(*app);
    add_materials(*app);
    add_synth(*app);
    add_fit(*app);
    add_render(*app);
    add_sheet(*app);
    add_budget(*app);
    add_tradeoff(*app);
    add_effects(*app);
    add_compare(*app);
    add_bench(*app);
    app->footer("Exit status: 0 done, 1 failed, 2 wrong usage."); // last: commands that follow would inherit it
    return app;
}

} // namespace slopemix::cli
