// slopemix_manual DIR: writes the manual page and the shells' completions of the command line into the folder DIR.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "commands.h"
#include "output.h"
#include "pages.h"

int main(int argc, char **argv) {
    using namespace slopemix;
    if (argc != 2) {
        std::fprintf(stderr, "usage: slopemix_manual DIR\n");
        return 2;
    }
    try {
        const manual::Program program = manual::read_program(*cli::make_app());
        const std::filesystem::path folder = argv[1];
        cli::write_text(folder / "slopemix.1", man_page(program));
        cli::write_text(folder / "slopemix", bash_completion(program));
        cli::write_text(folder / "_slopemix", zsh_completion(program));
        cli::write_text(folder / "slopemix.fish", fish_completion(program));
    } catch (const std::exception &error) {
        std::fprintf(stderr, "slopemix_manual: %s\n", error.what());
        return 1;
    }
    return 0;
}
