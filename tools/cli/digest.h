// SHA-256 in hexadecimal, by OpenSSL.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace slopemix::cli {

std::string sha256_of(std::string_view bytes);

// Empty for a file that cannot be read.
std::string sha256_of_file(const std::filesystem::path &file);

} // namespace slopemix::cli
