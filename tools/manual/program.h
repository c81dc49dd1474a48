// The command line as data: what the manual page and the completions are written from.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace slopemix::manual {

struct Flag {
    std::vector<std::string> names; // with their hyphens
    std::string value;              // its placeholder, as --help shows it; empty for a switch
    std::string help;
    std::vector<std::string> words;    // values that the placeholder spells out: of "auto|N", "auto"
    std::vector<std::string> excludes; // names of flags that may not stand beside it
    bool takes_file, is_required, is_repeatable;
};

struct Operand {
    std::string name, help;
    bool is_repeatable;
};

struct Command {
    std::string name, description, notes;
    std::vector<Operand> operands;
    std::vector<Flag> flags;
};

struct Program {
    Command self;
    std::string version;
    std::vector<Command> commands;
};

Program read_program(const CLI::App &app);

} // namespace slopemix::manual
