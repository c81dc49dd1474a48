// A number as a sentence says it.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace smx {

inline std::string short_number(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 3);
    return {digits.data(), end.ptr};
}

} // namespace smx
