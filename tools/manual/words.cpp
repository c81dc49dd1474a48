#include "words.h"

#include <algorithm>

namespace slopemix::manual {

std::string concat(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) text += part;
    return text;
}

std::string joined(const std::vector<std::string> &parts, std::string_view separator) {
    std::string text;
    for (const std::string &part : parts) {
        if (!text.empty()) text += separator;
        text += part;
    }
    return text;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

std::string first_clause(const std::string &text) {
    std::size_t end = text.size();
    for (const char *stop : {". ", ": ", "; ", " ("}) end = std::min(end, text.find(stop));
    return text.substr(0, end);
}

} // namespace slopemix::manual
