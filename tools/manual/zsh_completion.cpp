// By zsh's own _describe and _arguments.
#include "pages.h"

namespace slopemix::manual {

namespace {

std::string quoted(const std::string &text) { return concat({"'", replaced(text, "'", "'\\''"), "'"}); }

// Text between the marks of a specification.
std::string plain(std::string text) {
    for (const char *mark : {"\\", "[", "]", ":"}) text = replaced(text, mark, std::string("\\") + mark);
    return text;
}

// ":message:action" of a value.
std::string value_of(const Flag &flag) {
    if (flag.value.empty()) return "";
    std::string action = " "; // says what is wanted, and offers nothing
    if (flag.takes_file) action = "_files";
    if (!flag.words.empty()) action = concat({"(", joined(flag.words, " "), ")"});
    return concat({":", plain(flag.value), ":", action});
}

std::string flag_lines(const Flag &flag) {
    std::vector<std::string> refused = flag.excludes;
    if (!flag.is_repeatable) refused.insert(refused.end(), flag.names.begin(), flag.names.end());
    const std::string before = flag.is_repeatable ? "*" : concat({"(", joined(refused, " "), ")"});
    std::string lines;
    for (const std::string &name : flag.names) {
        const bool takes_equals = !flag.value.empty() && name.starts_with("--");
        lines += " \\\n                " + quoted(before + name + (takes_equals ? "=" : "") + "[" +
                                                  plain(first_clause(flag.help)) + "]" + value_of(flag));
    }
    return lines;
}

std::string arguments_of(const Command &command) {
    std::string lines;
    for (const Flag &flag : command.flags) lines += flag_lines(flag);
    for (const Operand &operand : command.operands)
        lines += " \\\n                " + quoted((operand.is_repeatable ? "*:" : ":") + operand.name + ":_files");
    return lines;
}

} // namespace

std::string zsh_completion(const Program &program) {
    std::string commands, cases;
    for (const Command &command : program.commands) {
        commands += "        " + quoted(plain(command.name) + ":" + first_clause(command.description)) + "\n";
        cases +=
            "        " + command.name + ")\n            _arguments -s" + arguments_of(command) + "\n            ;;\n";
    }
    const std::string script = R"(#compdef NAME
# zsh completion of NAME, generated from its command line
_NAME() {
    local -a commands=(
COMMANDS    )
    if ((CURRENT == 2)); then
        _describe -t commands command commands
        _arguments -sSELF
        return
    fi
    shift words
    ((CURRENT--))
    case $words[1] in
CASES    esac
}
_NAME "$@"
)";
    std::string filled = replaced(replaced(script, "COMMANDS", commands), "CASES", cases);
    filled = replaced(filled, "SELF", arguments_of(program.self));
    return replaced(filled, "NAME", program.self.name);
}

} // namespace slopemix::manual
