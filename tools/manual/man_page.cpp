// One page for all commands: man(7) has the macros.
#include <cctype>

#include "pages.h"

namespace slopemix::manual {

namespace {

// Text as roff takes it: a backslash and a hyphen are themselves, and a line does not begin like a macro.
std::string roff(const std::string &text) {
    const std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    return concat({"\\&", replaced(escaped, "\n", "\n\\&")});
}

std::string bold(const std::string &text) { return concat({"\\fB", replaced(text, "-", "\\-"), "\\fR"}); }
std::string italic(const std::string &text) { return concat({"\\fI", replaced(text, "-", "\\-"), "\\fR"}); }

std::string flag_entry(const Flag &flag) {
    std::vector<std::string> names;
    for (const std::string &name : flag.names) names.push_back(bold(name));
    std::string head = joined(names, ", ");
    if (!flag.value.empty()) head += concat({" ", italic(flag.value)});
    if (flag.is_repeatable) head += " ...";
    if (flag.is_required) head += " (required)";
    std::string body = concat({roff(flag.help), "."});
    if (!flag.excludes.empty()) body += concat({"\nNot with ", roff(joined(flag.excludes, ", ")), "."});
    return concat({".TP\n", head, "\n", body, "\n"});
}

std::string synopsis(const Program &program, const Command &command) {
    std::vector<std::string> words = {bold(concat({program.self.name, " ", command.name}))};
    for (const Operand &operand : command.operands)
        words.push_back(concat({italic(operand.name), operand.is_repeatable ? " ..." : ""}));
    for (const Flag &flag : command.flags)
        if (flag.is_required) words.push_back(concat({bold(flag.names.front()), " ", italic(flag.value)}));
    words.push_back(concat({"[", italic("flags"), "]"}));
    return joined(words, " ");
}

std::string command_section(const Program &program, const Command &command) {
    std::string section = concat({".SS ", command.name, "\n", synopsis(program, command), "\n"});
    section += concat({".PP\n", roff(command.description), ".\n"});
    for (const Operand &operand : command.operands)
        section += concat({".TP\n", italic(operand.name), "\n", roff(operand.help), ".\n"});
    for (const Flag &flag : command.flags)
        if (flag.names.back() != "--help") section += flag_entry(flag); // it stands with the command's own
    if (!command.notes.empty()) section += concat({".PP\n", roff(command.notes), "\n"});
    return section;
}

// "How a thing looks." as the one-line summary that mandb indexes.
std::string summary(std::string description) {
    description[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(description[0])));
    if (description.ends_with('.')) description.pop_back();
    return roff(description);
}

} // namespace

std::string man_page(const Program &program) {
    const Command &self = program.self;
    std::string page = concat({".TH SLOPEMIX 1 \"\" \"", self.name, " ", program.version, "\" \"User Commands\"\n"});
    page += ".nh\n.ad l\n";
    page += concat({".SH NAME\n", self.name, " \\- ", summary(self.description), "\n"});
    page += concat({".SH SYNOPSIS\n", bold(self.name), " ", italic("command"), " [", italic("argument"), " ...]\n"});
    page += concat({".SH DESCRIPTION\n", roff(self.description), "\n", roff(self.notes), "\n"});
    for (const Flag &flag : self.flags) page += flag_entry(flag);
    page += ".SH COMMANDS\n";
    for (const Command &command : program.commands) page += command_section(program, command);
    return page;
}

} // namespace slopemix::manual
