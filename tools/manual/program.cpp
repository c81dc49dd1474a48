// Walks the tree of the argument parser.
#include "program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "slopemix.h"

namespace slopemix::manual {

namespace {

bool is_small(char c) { return c >= 'a' && c <= 'z'; }

// Placeholders are in capitals; what is not is meant literally.
std::vector<std::string> literal_words(const std::string &placeholder) {
    std::vector<std::string> words;
    std::istringstream parts(placeholder);
    for (std::string part; std::getline(parts, part, '|');)
        if (!part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return is_small(c) || c == '-'; }))
            words.push_back(part);
    return words;
}

// "DIR", or a name with an ending, "X.exr".
bool names_file(const std::string &placeholder) {
    const std::size_t dot = placeholder.find('.');
    return placeholder == "DIR" ||
           (dot != std::string::npos && dot + 1 < placeholder.size() && is_small(placeholder[dot + 1]));
}

std::vector<std::string> names_of(const CLI::Option &option) {
    std::vector<std::string> names;
    for (const std::string &name : option.get_snames()) names.push_back("-" + name);
    for (const std::string &name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

Flag read_flag(const CLI::Option &option) {
    Flag flag = {};
    flag.names = names_of(option);
    flag.help = option.get_description();
    flag.is_required = option.get_required();
    flag.is_repeatable = option.get_expected_max() > 1;
    for (const CLI::Option *other : option.get_excludes())
        for (const std::string &name : names_of(*other)) flag.excludes.push_back(name);
    std::sort(flag.excludes.begin(), flag.excludes.end()); // CLI11 has them in the order of their addresses
    if (option.get_type_size() == 0) return flag;
    flag.value = option.get_type_name();
    flag.words = literal_words(flag.value);
    flag.takes_file = names_file(flag.value);
    return flag;
}

Command read_command(const CLI::App &app) {
    Command command = {app.get_name(), app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option *option : app.get_options()) {
        if (option->get_positional())
            command.operands.push_back(
                {option->get_name(true), option->get_description(), option->get_expected_max() > 1});
        else
            command.flags.push_back(read_flag(*option));
    }
    return command;
}

} // namespace

Program read_program(const CLI::App &app) {
    Program program = {read_command(app), smx_version(), {}};
    for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
        program.commands.push_back(read_command(*command));
    return program;
}

} // namespace slopemix::manual
