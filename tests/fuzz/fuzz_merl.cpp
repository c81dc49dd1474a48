// smx_brdf_open on MERL files. An input is a recipe, so that 35 MB of table need few bytes: the file's first 12 bytes,
// its length as 8 more, then pairs of an offset and the 8 bytes that stand there. All else is 0.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "memory.h"
#include "target.h"

namespace {

constexpr std::size_t header = 12, pair = 16;
constexpr std::uint64_t longest = 80'000'000; // a table over the full azimuth has 70 MB

// The file's bytes, its values, and less than as much again: which cells are valid, and how holes are filled.
constexpr std::size_t table_factor = 3;

template <class T>
std::string bytes_of(const T &value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

std::uint64_t number_at(const uint8_t *data) {
    std::uint64_t number = 0;
    std::memcpy(&number, data, sizeof number);
    return number;
}

std::string recipe(std::int32_t phi_d, std::uint64_t length,
                   const std::vector<std::pair<std::uint64_t, double>> &values) {
    std::string bytes = bytes_of(std::array<std::int32_t, 3>{90, 90, phi_d}) + bytes_of(length);
    for (const auto &[at, value] : values) bytes += bytes_of(at) + bytes_of(value);
    return bytes;
}

void make_file(fuzz::MemoryFile &file, const uint8_t *data, std::size_t size) {
    const std::uint64_t length = size >= header + 8 ? number_at(data + header) % longest : size;
    file.resize(length);
    file.put(0, data, std::min<std::size_t>({size, header, length}));
    for (std::size_t at = header + 8; at + pair <= size && length >= 8; at += pair)
        file.put(number_at(data + at) % (length - 7), data + at + 8, 8);
}

// What the file's header declares: doubles of three channels. Of other dimensions nothing may be read.
std::size_t declared_bytes(const uint8_t *data, std::size_t size) {
    std::array<std::int32_t, 3> dims{};
    if (size < header) return 0;
    std::memcpy(dims.data(), data, header);
    const bool is_legal = dims[0] == 90 && dims[1] == 90 && (dims[2] == 180 || dims[2] == 360);
    return is_legal ? std::size_t{3} * 8 * 90 * 90 * static_cast<std::size_t>(dims[2]) : 0;
}

void require_sound(smx_brdf brdf) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    fuzz::require_ok(smx_brdf_get_info(brdf, &info), "facts about a table");
    std::vector<double> values(3 * info.cells);
    fuzz::require_ok(smx_brdf_get_values(brdf, values.data(), values.size()), "a table's values");
    bool sound = true;
    for (const double value : values) sound = sound && std::isfinite(value);
    fuzz::require(sound && info.invalid_cells < info.cells && info.filled_cells <= info.invalid_cells, "a sound table");
}

} // namespace

std::vector<std::string> fuzz::seeds() {
    constexpr std::uint64_t short_table = 34'992'012, long_table = 69'984'012;
    return {recipe(180, short_table, {{12, 0.5}, {1012, -1.0}}),
            recipe(360, long_table, {{69'984'004, 1e300}}),
            recipe(180, short_table, {{20, NAN}, {12 + 8 * 1'458'000, 1e-300}}),
            recipe(180, short_table - 1, {}),
            recipe(181, short_table, {}),
            recipe(-1, 12, {}),
            "Z"};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static fuzz::MemoryFile file;
    make_file(file, data, size);
    smx_brdf brdf = nullptr;
    smx_status status;
    {
        const fuzz::MemoryLimit limit(table_factor * declared_bytes(data, size) + fuzz::always_legal);
        status = smx_brdf_open(file.path().c_str(), &brdf);
    }
    fuzz::require_outcome(status, brdf, {SMX_BAD_FORMAT});
    if (brdf) require_sound(brdf);
    smx_brdf_release(brdf);
    return 0;
}
