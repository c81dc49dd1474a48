// An RGBA float image, row 0 at the top, with text attributes that go with it into EXR headers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace smx {

struct Image {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba;   // [height][width][4]; alpha 1 on the surface, 0 off it
    std::vector<float> errors; // standard errors of R, G, B and the pixel's alpha, [height][width][4]; or empty
    std::map<std::string, std::string> attributes;

    Image(std::uint32_t width, std::uint32_t height); // black, alpha 0
    Image(std::uint32_t width, std::uint32_t height, std::vector<float> rgba);
    std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
};

// EXR: R, G, B, A as float32, scan lines, and error.R, error.G, error.B for an image with standard errors. read_exr
// takes any EXR with R, G and B; alpha is 1 where there is no A, and there are errors where all three are.
Image read_exr(const std::string &path);
void write_exr(const Image &image, const std::string &path);

// A key that may become an EXR attribute. Throws InvalidArgument.
void validate_attribute_key(const std::string &key);

// 8-bit display pixels [height][width][3]: sRGB transfer of clip(exposure * linear) over the blue background.
std::vector<std::uint8_t> display_pixels(const Image &image, double exposure);
void write_png(const Image &image, const std::string &path, double exposure);

// q-quantile of the R, G, B values of pixels with alpha > 0; 0 if there are none.
double quantile(const Image &image, double q);

struct Comparison {
    double relrmse = 0.0, rmse = 0.0, max_error = 0.0, bias = 0.0;
    std::uint64_t pixels = 0;
};

// Over the pixels with alpha > 0 in the reference and the three channels. Throws InvalidArgument for different sizes or
// no such pixel.
Comparison compare(const Image &image, const Image &reference);

} // namespace smx
