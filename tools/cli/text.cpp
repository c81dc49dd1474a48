// Numbers by std::to_chars, tables by padding.
#include "text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <ostream>

namespace slopemix::cli {

namespace {

std::string format(double value, std::chars_format style, int precision) {
    std::array<char, 400> buffer; // the longest double has 309 digits before its point
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, style, precision);
    return error == std::errc() ? std::string(buffer.data(), end) : "?";
}

std::string padded(const std::string &text, std::size_t width) {
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

} // namespace

std::string fixed(double value, int decimals) { return format(value, std::chars_format::fixed, decimals); }
std::string general(double value, int digits) { return format(value, std::chars_format::general, digits); }

void print_facts(std::ostream &out, const Facts &facts) {
    std::size_t width = 0;
    for (const auto &[name, value] : facts) width = std::max(width, name.size());
    for (const auto &[name, value] : facts) out << name << std::string(width + 2 - name.size(), ' ') << value << '\n';
}

void print_table(std::ostream &out, const std::vector<TextRow> &rows) {
    std::vector<std::size_t> widths;
    for (const TextRow &row : rows) {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
    }
    for (const TextRow &row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) out << (k ? "  " : "") << padded(row[k], widths[k]);
        out << '\n';
    }
}

std::string to_utf8(const std::string &text) {
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

} // namespace slopemix::cli
