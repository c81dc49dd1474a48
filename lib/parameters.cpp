#include "parameters.h"

#include <algorithm>
#include <vector>

#include "error.h"
#include "parse_number.h"

namespace smx {

namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

} // namespace

Parameters::Parameters(const std::string &specification) : specification_(specification) {
    const std::vector<std::string_view> parts = split(specification, ',');
    kind_ = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k) {
        const std::size_t equals = parts[k].find('=');
        require(equals != std::string_view::npos, "analytic:", specification_, ": \"", parts[k], "\" is not key=value");
        const std::string key(parts[k].substr(0, equals));
        const bool is_new = values_.emplace(key, parts[k].substr(equals + 1)).second;
        require(is_new, "analytic:", specification_, ": ", key, " is given twice");
    }
}

void Parameters::expect(std::initializer_list<std::string_view> keys) const {
    std::string list;
    for (const std::string_view key : keys) list += (list.empty() ? "" : ", ") + std::string(key);
    for (const auto &[key, value] : values_)
        require(std::find(keys.begin(), keys.end(), key) != keys.end(), "analytic:", specification_, ": no key \"", key,
                "\"; ", kind_, " has ", list);
    for (const std::string_view key : keys)
        require(values_.contains(key), "analytic:", specification_, ": ", key, " is missing; ", kind_, " needs ", list);
}

double Parameters::parse(const std::string &key, std::string_view text, NumberRange range) const {
    const std::optional<double> value = parse_number(text);
    require(value && *value >= range.low && *value <= range.high, "analytic:", specification_, ": ", key, " is \"",
            text, "\"; it must be a number in ", range.low, "..", range.high);
    return *value;
}

double Parameters::number(const std::string &key, NumberRange range) const {
    return parse(key, values_.at(key), range);
}

Rgb Parameters::colour(const std::string &key, NumberRange range) const {
    const std::string &text = values_.at(key);
    const std::vector<std::string_view> parts = split(text, '/');
    require(parts.size() == 1 || parts.size() == 3, "analytic:", specification_, ": ", key, " is \"", text,
            "\"; it must be one number, or three joined by slashes");
    Rgb colour{};
    for (std::size_t c = 0; c < 3; ++c) colour[c] = parse(key, parts[parts.size() == 1 ? 0 : c], range);
    return colour;
}

} // namespace smx
