// The layout, from "OpenEXR File Layout" (openexr.com): a magic number, flags, then headers of attributes, each a name
// and a type that end in 0, a size and as many bytes; an empty name ends a header, and an empty header the headers of a
// file of several parts.
#include "exr_header.h"

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>

#include "error.h"

namespace smx {

static_assert(std::endian::native == std::endian::little, "EXR files are little-endian, and are read in place");

namespace {

constexpr std::uint32_t magic = 20000630, several_parts = 1u << 12;

template <typename T>
T read_number(std::ifstream &in) {
    std::array<char, sizeof(T)> bytes{};
    in.read(bytes.data(), bytes.size());
    return std::bit_cast<T>(bytes);
}

std::string read_name(std::ifstream &in) {
    std::string name;
    std::getline(in, name, '\0');
    return name;
}

} // namespace

void expect_sound_exr_header(const std::string &path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    in.exceptions(std::ios::badbit); // a name that memory did not suffice for is not an empty one
    const std::streamoff length = in.tellg();
    in.seekg(0);
    if (read_number<std::uint32_t>(in) != magic) return;
    const bool has_parts = (read_number<std::uint32_t>(in) & several_parts) != 0;
    while (in) {
        if (read_name(in).empty()) {
            if (!has_parts || in.peek() == 0) return;
            continue;
        }
        read_name(in); // its type
        const auto size = read_number<std::int32_t>(in);
        const std::streamoff at = in.tellg();
        if (!in) break;
        if (size < 0 || size > length - at)
            fail(Fault::BadFormat, path, ": an attribute of ", size, " bytes at byte ", at, ", of ", length);
        in.seekg(size, std::ios::cur);
    }
    fail(Fault::BadFormat, path, ": the header has no end");
}

} // namespace smx
