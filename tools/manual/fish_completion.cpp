// One `complete` per command and flag.
#include "pages.h"

namespace slopemix::manual {

namespace {

std::string quoted(const std::string &text) {
    return concat({"'", replaced(replaced(text, "\\", "\\\\"), "'", "\\'"), "'"});
}

std::string flag_line(const std::string &begin, const Flag &flag) {
    std::string line = begin;
    for (const std::string &name : flag.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!flag.value.empty()) line += flag.takes_file ? " -r -F" : " -x";
    if (!flag.words.empty()) line += " -a " + quoted(joined(flag.words, " "));
    return line + " -d " + quoted(first_clause(flag.help)) + "\n";
}

} // namespace

std::string fish_completion(const Program &program) {
    const std::string complete = "complete -c " + program.self.name + " -n ";
    std::string script = "# fish completion of " + program.self.name + ", generated from its command line\n";
    for (const Flag &flag : program.self.flags) script += flag_line(complete + "__fish_use_subcommand", flag);
    for (const Command &command : program.commands) {
        script += complete + "__fish_use_subcommand -f -a " + command.name + " -d " +
                  quoted(first_clause(command.description)) + "\n";
        for (const Flag &flag : command.flags)
            script += flag_line(complete + quoted("__fish_seen_subcommand_from " + command.name), flag);
    }
    return script;
}

} // namespace slopemix::manual
