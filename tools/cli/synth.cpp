// slopemix synth: writes a built-in or analytic material as a MERL table.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "input.h"
#include "output.h"

namespace slopemix::cli {

namespace {

struct SynthFlags {
    std::string input, out;
};

void run(const SynthFlags &flags) {
    if (!is_synthetic(flags.input))
        throw CLI::ValidationError("INPUT", "'" + flags.input + "' is neither builtin:NAME nor analytic:KIND,...");
    require_writable(flags.out);
    const Brdf brdf = open_brdf(flags.input);
    make_folder_of(flags.out);
    check(smx_brdf_write(brdf.get(), flags.out.c_str()));
    std::cout << flags.out << '\n';
}

} // namespace

void add_synth(CLI::App &app) {
    CLI::App *command = app.add_subcommand("synth", "Write a built-in or analytic material as a MERL table");
    const auto flags = std::make_shared<SynthFlags>();
    command->add_option("INPUT", flags->input, synthetic_help)->required()->type_name("");
    command->add_option("--out", flags->out, "The table to write")->required()->type_name("F.binary");
    command->callback([flags] { run(*flags); });
}

} // namespace slopemix::cli
