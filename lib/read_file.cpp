#include "read_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "error.h"

namespace smx {

std::string read_file(const std::string &path, std::size_t max_bytes) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) fail(Fault::CannotRead, "cannot read ", path, ": it is a folder");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) fail(Fault::CannotRead, "cannot read ", path, ": ", std::strerror(errno ? errno : ENOENT));

    // By parts, whatever the file says of its length: it may be a device or a pipe.
    std::string bytes;
    std::array<char, 1 << 16> part;
    while (in && bytes.size() <= max_bytes) {
        in.read(part.data(), part.size());
        bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad()) fail(Fault::CannotRead, "cannot read ", path, " to its end");
    if (bytes.size() > max_bytes) fail(Fault::BadFormat, path, ": more than the ", max_bytes, " bytes that are legal");
    return bytes;
}

} // namespace smx
