// slopemix: the command line. Runs a command and turns what it throws into messages and exit statuses:
// 0 done, 1 failed, 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "commands.h"
#include "handles.h"
#include "interrupt.h"

namespace {

constexpr int failed = 1;
constexpr int wrong_usage = 2;

// CLI11 says that a command is missing before it looks at what stands in its place.
std::string usage_message(const CLI::App &app, const CLI::ParseError &error) {
    const std::vector<std::string> unknown = app.remaining();
    if (!app.get_subcommands().empty() || unknown.empty()) return error.what();
    return (unknown.front().starts_with('-') ? "unknown flag '" : "unknown command '") + unknown.front() + "'";
}

int report_parse_result(const CLI::App &app, const CLI::ParseError &result) {
    if (result.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(result); // --help
    std::cerr << "slopemix: " << usage_message(app, result) << "\nRun with --help for more information.\n";
    return wrong_usage;
}

int run(int argc, char **argv) {
    using namespace slopemix::cli;

    const std::unique_ptr<CLI::App> app = make_app();
    cancel_on_interrupt();
    try {
        app->parse(argc, argv);
    } catch (const CLI::ParseError &result) {
        return report_parse_result(*app, result);
    }
    if (!std::cout.flush()) throw CommandError("cannot write to standard output");
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "slopemix: %s\n", error.what());
        return failed;
    }
}
