// The values of flags: text to numbers, pairs, lists, resolutions and image names. Independent of the locale.
// What is malformed or out of its range throws std::invalid_argument with the value and the legal range.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace slopemix::cli {

struct NumberRange {
    double low, high;
};

struct CountRange {
    std::uint64_t low, high;
};

struct Resolution {
    std::uint32_t width, height;
};

// T.R.C of the sheet, counted from 1.
struct ImageId {
    std::uint32_t table, row, column;
    bool operator<(const ImageId &other) const {
        return std::tie(table, row, column) < std::tie(other.table, other.row, other.column);
    }
};

double parse_number(std::string_view text, NumberRange range);
std::uint64_t parse_count(std::string_view text, CountRange range);
std::pair<double, double> parse_pair(std::string_view text, NumberRange range); // "A,B"
std::vector<double> parse_numbers(std::string_view text, NumberRange range);    // "A,B,..."
std::vector<std::uint32_t> parse_counts(std::string_view text, CountRange range);
Resolution parse_resolution(std::string_view text);          // "W" is W x W, or "WxH"
std::vector<ImageId> parse_image_ids(std::string_view text); // "T.R.C,..."

std::string to_string(const ImageId &id);

// A word of the command line and what it stands for.
template <class Value>
struct Choice {
    const char *word;
    Value value;
};

template <class Value, std::size_t count>
std::string words_of(const Choice<Value> (&choices)[count]) {
    std::string words;
    for (const auto &choice : choices) words += (words.empty() ? "" : "|") + std::string(choice.word);
    return words;
}

template <class Value, std::size_t count>
Value parse_choice(std::string_view text, const Choice<Value> (&choices)[count]) {
    for (const auto &choice : choices)
        if (text == choice.word) return choice.value;
    throw std::invalid_argument("'" + std::string(text) + "' is not one of " + words_of(choices));
}

template <class Value, std::size_t count>
const char *word_for(Value value, const Choice<Value> (&choices)[count]) {
    for (const auto &choice : choices)
        if (value == choice.value) return choice.word;
    return "unknown";
}

} // namespace slopemix::cli
