// Writes MERL `.binary` files for the tests, good and bad: three int32 and float64 planes, scaled per channel.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "files.h"
#include "oracle_table.h"

namespace test {

inline constexpr std::array<double, 3> merl_scale{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};

template <class T>
void append(std::string &bytes, const T &value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

inline std::string merl_bytes(const std::array<int32_t, 3> &dims, const std::vector<double> &scaled) {
    std::string bytes;
    bytes.reserve(12 + 8 * scaled.size());
    for (const int32_t d : dims) append(bytes, d);
    bytes.append(reinterpret_cast<const char *>(scaled.data()), 8 * scaled.size());
    return bytes;
}

// The file's units: 1/sr over the channel's scale; invalid cells -1.
inline std::vector<double> merl_scaled(const oracle::Table &table) {
    std::vector<double> scaled = table.values;
    for (std::size_t k = 0; k < scaled.size(); ++k)
        scaled[k] = scaled[k] < 0.0 ? -1.0 : scaled[k] / merl_scale[k / table.cells()];
    return scaled;
}

inline std::string merl_file(const oracle::Table &table) {
    return merl_bytes({90, 90, table.phi_d}, merl_scaled(table));
}

} // namespace test
