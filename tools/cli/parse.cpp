// Parsing of flag values with std::from_chars, which knows no locale.
#include "parse.h"

#include <array>
#include <charconv>
#include <system_error>

#include "text.h"

namespace slopemix::cli {

namespace {

[[noreturn]] void refuse(std::string_view text, const std::string &demand) {
    throw std::invalid_argument("'" + std::string(text) + "' is not " + demand);
}

// The whole of the text as a number; std::from_chars alone would stop at the first odd character and refuse a plus.
template <class Number>
bool read_whole(std::string_view text, Number &value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char *const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

std::string in_range(NumberRange range) { return " in " + general(range.low) + ".." + general(range.high); }
std::string in_range(CountRange range) {
    return " in " + std::to_string(range.low) + ".." + std::to_string(range.high);
}

ImageId parse_image_id(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, '.');
    std::array<std::uint32_t, 3> place = {};
    bool is_name = parts.size() == place.size();
    for (std::size_t k = 0; is_name && k < place.size(); ++k) is_name = read_whole(parts[k], place[k]) && place[k] > 0;
    if (!is_name) refuse(text, "an image's name, TABLE.ROW.COLUMN, each counted from 1");
    return {place[0], place[1], place[2]};
}

} // namespace

double parse_number(std::string_view text, NumberRange range) {
    double value = 0.0;
    if (!read_whole(text, value) || !(value >= range.low && value <= range.high))
        refuse(text, "a number" + in_range(range));
    return value;
}

std::uint64_t parse_count(std::string_view text, CountRange range) {
    std::uint64_t value = 0;
    if (!read_whole(text, value) || value < range.low || value > range.high)
        refuse(text, "a whole number" + in_range(range));
    return value;
}

std::pair<double, double> parse_pair(std::string_view text, NumberRange range) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 2) refuse(text, "two numbers with a comma between them");
    return {parse_number(parts[0], range), parse_number(parts[1], range)};
}

std::vector<double> parse_numbers(std::string_view text, NumberRange range) {
    std::vector<double> values;
    for (const std::string_view part : split(text, ',')) values.push_back(parse_number(part, range));
    return values;
}

std::vector<std::uint32_t> parse_counts(std::string_view text, CountRange range) {
    std::vector<std::uint32_t> values;
    for (const std::string_view part : split(text, ','))
        values.push_back(static_cast<std::uint32_t>(parse_count(part, range)));
    return values;
}

Resolution parse_resolution(std::string_view text) {
    constexpr CountRange side = {1, 16384};
    const std::vector<std::string_view> parts = split(text, 'x');
    if (parts.size() > 2) refuse(text, "a resolution, W or WxH");
    const auto part = [&](std::size_t k) { return static_cast<std::uint32_t>(parse_count(parts[k], side)); };
    return {part(0), part(parts.size() - 1)};
}

std::vector<ImageId> parse_image_ids(std::string_view text) {
    std::vector<ImageId> ids;
    for (const std::string_view part : split(text, ',')) ids.push_back(parse_image_id(part));
    return ids;
}

std::string to_string(const ImageId &id) {
    return std::to_string(id.table) + '.' + std::to_string(id.row) + '.' + std::to_string(id.column);
}

} // namespace slopemix::cli
