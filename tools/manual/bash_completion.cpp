// Names of commands and flags, words that a flag takes, and files; nothing where a number is wanted.
#include "pages.h"

namespace slopemix::manual {

namespace {

std::string flag_names(const Command &command) {
    std::vector<std::string> names;
    for (const Flag &flag : command.flags) names.insert(names.end(), flag.names.begin(), flag.names.end());
    return joined(names, " ");
}

// What to offer after a flag that takes a value.
std::string value_case(const Command &command, const Flag &flag) {
    if (flag.value.empty() || flag.takes_file) return ""; // files are what is offered otherwise
    std::string pattern;
    for (const std::string &name : flag.names) pattern += (pattern.empty() ? "" : "|") + command.name + ":" + name;
    return "        " + pattern + ") choices='" + joined(flag.words, " ") + "' ;;\n";
}

} // namespace

std::string bash_completion(const Program &program) {
    std::string commands, values, flags;
    for (const Command &command : program.commands) {
        commands += command.name + " ";
        flags += "        " + command.name + ") choices='" + flag_names(command) + "' ;;\n";
        for (const Flag &flag : command.flags) values += value_case(command, flag);
    }
    std::string script = R"(# bash completion of NAME, generated from its command line
_NAME() {
    local current=${COMP_WORDS[COMP_CWORD]} choices=-
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W 'COMMANDS' -- "$current")
        return
    fi
    case ${COMP_WORDS[1]}:${COMP_WORDS[COMP_CWORD - 1]} in
VALUES    esac
    [[ $choices != - || $current != -* ]] || case ${COMP_WORDS[1]} in
FLAGS    esac
    if [[ $choices == - ]]; then
        compopt -o default
    else
        mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
    fi
}
complete -F _NAME NAME
)";
    script = replaced(script, "COMMANDS", commands + flag_names(program.self));
    script = replaced(replaced(script, "VALUES", values), "FLAGS", flags);
    return replaced(script, "NAME", program.self.name);
}

} // namespace slopemix::manual
