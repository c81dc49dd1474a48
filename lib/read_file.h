// A whole text file in memory.
#pragma once

#include <cstddef>
#include <string>

namespace smx {

// Throws CannotRead, and BadFormat for a file of more than `max_bytes`.
std::string read_file(const std::string &path, std::size_t max_bytes);

} // namespace smx
