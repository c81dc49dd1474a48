// The channels of our EXR files, and rows of four floats as OpenEXR sees them.
#pragma once

#include <OpenEXR/ImfFrameBuffer.h>

#include <array>
#include <cstddef>

namespace smx {

using ChannelNames = std::array<const char *, 4>;
inline constexpr ChannelNames image_channels = {"R", "G", "B", "A"};
inline constexpr ChannelNames error_channels = {"error.R", "error.G", "error.B", nullptr}; // alpha is the image's

// (x, y) is the first pixel's place in the file's data window.
inline void insert_rows(Imf::FrameBuffer &buffer, const ChannelNames &names, float *rows, std::size_t width,
                        std::ptrdiff_t x, std::ptrdiff_t y) {
    const std::size_t pixel = 4 * sizeof(float), row = width * pixel;
    char *origin =
        reinterpret_cast<char *>(rows) - x * static_cast<std::ptrdiff_t>(pixel) - y * static_cast<std::ptrdiff_t>(row);
    for (std::size_t c = 0; c < 4; ++c)
        if (names[c])
            buffer.insert(names[c], Imf::Slice(Imf::FLOAT, origin + c * sizeof(float), pixel, row, 1, 1, c == 3));
}

} // namespace smx
