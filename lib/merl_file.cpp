#include "merl_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "atomic_file.h"
#include "error.h"
#include "sha256.h"

namespace smx {

static_assert(std::endian::native == std::endian::little, "MERL files are little-endian, and are read in place");

namespace fs = std::filesystem;

namespace {

constexpr Rgb channel_scale = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
constexpr std::size_t header_bytes = 3 * sizeof(std::int32_t);

std::size_t file_bytes(std::size_t phi_d_count) {
    return header_bytes + 3 * Brdf::theta_h_count * Brdf::theta_d_count * phi_d_count * sizeof(double);
}

// The file's length is checked against its dimensions before anything of that size is allocated.
std::string read_checked(const std::string &path) {
    std::error_code status;
    if (fs::is_directory(path, status)) fail(Fault::CannotRead, "cannot read ", path, ": it is a folder");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) fail(Fault::CannotRead, "cannot read ", path, ": ", std::strerror(errno ? errno : ENOENT));
    const auto length = fs::file_size(path, status);
    if (status) fail(Fault::CannotRead, "cannot read ", path, ": ", status.message());
    if (length < header_bytes)
        fail(Fault::BadFormat, path, ": ", length, " bytes are too few for a MERL header of ", header_bytes);

    std::array<std::int32_t, 3> dims{};
    std::array<char, header_bytes> header{};
    in.read(header.data(), header.size());
    std::memcpy(dims.data(), header.data(), header_bytes);
    if (dims[0] != 90 || dims[1] != 90 || (dims[2] != 180 && dims[2] != 360))
        fail(Fault::BadFormat, path, ": dimensions ", dims[0], " x ", dims[1], " x ", dims[2],
             "; a MERL table has 90 x 90 x 180 or 90 x 90 x 360");
    const std::size_t expected = file_bytes(static_cast<std::size_t>(dims[2]));
    if (length != expected)
        fail(Fault::BadFormat, path, ": ", length, " bytes, but its dimensions need ", expected,
             length < expected ? " (truncated)" : " (oversized)");

    std::string bytes(expected, '\0');
    in.seekg(0);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in) fail(Fault::CannotRead, "cannot read ", path, " to its end");
    return bytes;
}

std::size_t phi_d_of(const std::string &bytes) {
    std::int32_t count = 0;
    std::memcpy(&count, bytes.data() + 2 * sizeof count, sizeof count);
    return static_cast<std::size_t>(count);
}

} // namespace

Brdf read_merl(const std::string &path) {
    const std::string bytes = read_checked(path);
    std::vector<double> values((bytes.size() - header_bytes) / sizeof(double));
    std::memcpy(values.data(), bytes.data() + header_bytes, values.size() * sizeof(double));
    for (std::size_t at = 0; at < values.size(); ++at) values[at] *= channel_scale[at / (values.size() / 3)];
    return Brdf(fs::path(path).stem().string(), path, sha256_hex(bytes), phi_d_of(bytes), std::move(values));
}

std::string merl_bytes(std::size_t phi_d_count, const std::vector<double> &values) {
    std::string bytes(file_bytes(phi_d_count), '\0');
    const std::array<std::int32_t, 3> dims = {90, 90, static_cast<std::int32_t>(phi_d_count)};
    std::memcpy(bytes.data(), dims.data(), header_bytes);
    for (std::size_t at = 0; at < values.size(); ++at) {
        const double scaled = values[at] < 0.0 ? -1.0 : values[at] / channel_scale[at / (values.size() / 3)];
        std::memcpy(bytes.data() + header_bytes + at * sizeof scaled, &scaled, sizeof scaled);
    }
    return bytes;
}

std::string merl_bytes(const Brdf &brdf) {
    std::vector<double> values = brdf.values();
    for (std::size_t at = 0; at < values.size(); ++at)
        if (!brdf.valid(at % brdf.cells())) values[at] = -1.0;
    return merl_bytes(brdf.phi_d_count(), values);
}

void write_merl(const Brdf &brdf, const std::string &path) { write_atomically(path, merl_bytes(brdf)); }

} // namespace smx
