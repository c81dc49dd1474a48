// The layout, from "OpenEXR File Layout" (openexr.com): a magic number, flags, then headers of attributes, each a name
// and a type that end in 0, a size and as many bytes; an empty name ends a header, and an empty header the headers of a
// file of several parts.
#include "exr_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "error.h"

namespace smx {

static_assert(std::endian::native == std::endian::little, "EXR files are little-endian, and are read in place");

namespace {

constexpr std::uint32_t magic = 20000630, several_parts = 1u << 12;

// OpenEXR reads these types by their own size, whatever the file says, and goes on from there.
struct Type {
    std::string_view name;
    std::int64_t bytes;
};
constexpr Type fixed_types[] = {{"box2f", 16},
                                {"box2i", 16},
                                {"chromaticities", 32},
                                {"compression", 1},
                                {"deepImageState", 1},
                                {"double", 8},
                                {"envmap", 1},
                                {"float", 4},
                                {"int", 4},
                                {"keycode", 28},
                                {"lineOrder", 1},
                                {"m33d", 72},
                                {"m33f", 36},
                                {"m44d", 128},
                                {"m44f", 64},
                                {"rational", 8},
                                {"tiledesc", 9},
                                {"timecode", 8},
                                {"v2d", 16},
                                {"v2f", 8},
                                {"v2i", 8},
                                {"v3d", 24},
                                {"v3f", 12},
                                {"v3i", 12}};

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

// A name, a type and 12 more bytes for each channel; an empty name ends them.
std::int64_t channel_list_bytes(std::ifstream &in) {
    const std::streamoff begin = in.tellg();
    while (!read_name(in).empty()) in.seekg(16, std::ios::cur);
    return in ? std::streamoff(in.tellg()) - begin : -1;
}

// The bytes that OpenEXR takes for a value of this type, which begins here; those that the file says where it goes by
// them.
std::int64_t own_bytes(std::ifstream &in, const std::string &type, std::int64_t said) {
    if (type == "chlist") return channel_list_bytes(in);
    if (type == "preview") {
        const auto width = read_number<std::uint32_t>(in), height = read_number<std::uint32_t>(in);
        const double bytes = 8.0 + 4.0 * width * height; // exact wherever it can be what the file says
        return bytes == static_cast<double>(said) ? said : -1;
    }
    const auto *found =
        std::find_if(std::begin(fixed_types), std::end(fixed_types), [&](const Type &t) { return t.name == type; });
    return found == std::end(fixed_types) ? said : found->bytes;
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
        const std::string type = read_name(in);
        const auto size = read_number<std::int32_t>(in);
        const std::streamoff at = in.tellg();
        if (!in) break;
        if (size < 0 || size > length - at)
            fail(Fault::BadFormat, path, ": an attribute of ", size, " bytes at byte ", at, ", of ", length);
        if (own_bytes(in, type, size) != size)
            fail(Fault::BadFormat, path, ": an attribute of ", size, " bytes at byte ", at, " is no ", type);
        in.seekg(at + size);
    }
    fail(Fault::BadFormat, path, ": the header has no end");
}

} // namespace smx
