// Text that is put together.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace slopemix::manual {

std::string concat(std::initializer_list<std::string_view> parts);
std::string joined(const std::vector<std::string> &parts, std::string_view separator);
std::string replaced(std::string text, std::string_view from, std::string_view to);

// Up to the first stop, colon, semicolon or parenthesis: what fits beside a completion.
std::string first_clause(const std::string &text);

} // namespace slopemix::manual
