// Numbers and tables for people. Independent of the locale.
#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace slopemix::cli {

std::string fixed(double value, int decimals);
std::string general(double value, int digits = 6);

// Lines of "name  value", values aligned.
using Facts = std::vector<std::pair<std::string, std::string>>;
void print_facts(std::ostream &out, const Facts &facts);

// Rows of cells in right-aligned columns; the first row holds the headings.
using TextRow = std::vector<std::string>;
void print_table(std::ostream &out, const std::vector<TextRow> &rows);

// The text with every byte that is not UTF-8 replaced: file names may hold any byte, JSON and fonts may not.
std::string to_utf8(const std::string &text);

} // namespace slopemix::cli
