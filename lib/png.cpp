// 8-bit display pixels, and PNG files by libpng's simplified interface.
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "atomic_file.h"
#include "error.h"
#include "image.h"

namespace smx {

namespace {

constexpr std::array<std::uint8_t, 3> background = {58, 110, 176};

// IEC 61966-2-1.
double srgb_transfer(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

} // namespace

std::vector<std::uint8_t> display_pixels(const Image &image, double exposure) {
    require(exposure > 0.0 && std::isfinite(exposure), "exposure is ", exposure, "; it must be above 0");
    std::vector<std::uint8_t> rgb(3 * image.pixels());
    for (std::size_t at = 0; at < image.pixels(); ++at) {
        const float *pixel = &image.rgba[4 * at];
        const double alpha = std::clamp(static_cast<double>(pixel[3]), 0.0, 1.0);
        for (std::size_t c = 0; c < 3; ++c) {
            const double shown = 255.0 * srgb_transfer(std::clamp(exposure * pixel[c], 0.0, 1.0));
            rgb[3 * at + c] = static_cast<std::uint8_t>(std::lround(shown * alpha + background[c] * (1.0 - alpha)));
        }
    }
    return rgb;
}

void write_png(const Image &image, const std::string &path, double exposure) {
    const std::vector<std::uint8_t> rgb = display_pixels(image, exposure);
    write_atomically(path, [&](const std::string &temporary) {
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        png.width = image.width;
        png.height = image.height;
        png.format = PNG_FORMAT_RGB;
        if (!png_image_write_to_file(&png, temporary.c_str(), 0, rgb.data(), 0, nullptr))
            fail(Fault::CannotWrite, "cannot write ", path, ": ", png.message);
    });
}

} // namespace smx
