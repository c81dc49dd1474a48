// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace smx {

// Calls write(temporary) and renames the result to `path`. Whatever fails, `path` is as it was and the temporary is
// gone. Throws CannotWrite.
void write_atomically(const std::string &path, const std::function<void(const std::string &temporary)> &write);

// The same for bytes at hand.
void write_atomically(const std::string &path, std::string_view bytes);

} // namespace smx
