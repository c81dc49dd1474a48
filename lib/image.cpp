#include "image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "error.h"
#include "scene.h"

namespace smx {

namespace {

std::size_t legal_values(std::uint32_t width, std::uint32_t height) {
    require(width >= 1 && width <= max_side, "image width is ", width, "; it must be 1..", max_side);
    require(height >= 1 && height <= max_side, "image height is ", height, "; it must be 1..", max_side);
    return std::size_t{4} * width * height;
}

} // namespace

Image::Image(std::uint32_t image_width, std::uint32_t image_height)
    : Image(image_width, image_height, std::vector<float>(legal_values(image_width, image_height))) {}

Image::Image(std::uint32_t image_width, std::uint32_t image_height, std::vector<float> values)
    : width(image_width), height(image_height), rgba(std::move(values)) {
    const std::size_t legal = legal_values(width, height);
    require(rgba.size() == legal, "an image of ", width, " x ", height, " pixels has ", legal, " values, not ",
            rgba.size());
}

double quantile(const Image &image, double q) {
    require(q >= 0.0 && q <= 1.0, "q is ", q, "; it must be 0..1");
    std::vector<float> values;
    for (std::size_t at = 0; at < image.rgba.size(); ++at)
        if (at % 4 != 3 && image.rgba[at | 3] > 0.0f && !std::isnan(image.rgba[at])) values.push_back(image.rgba[at]);
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::ptrdiff_t>(std::llround(q * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

namespace {

struct Sums {
    double a = 0.0, b = 0.0, b2 = 0.0, difference2 = 0.0, max_difference = 0.0;
    std::uint64_t pixels = 0;

    void add(double value, double reference) {
        const double difference = value - reference;
        a += value;
        b += reference;
        b2 += reference * reference;
        difference2 += difference * difference;
        // Written so that a NaN enters, and stays.
        if (!std::isnan(max_difference) && !(std::abs(difference) <= max_difference))
            max_difference = std::abs(difference);
    }
};

// a / b, where 0 / 0 is `both_zero` and anything else over 0 is infinite.
double ratio(double a, double b, double both_zero) {
    if (b != 0.0) return a / b;
    return a == 0.0 ? both_zero : std::numeric_limits<double>::infinity();
}

} // namespace

Comparison compare(const Image &image, const Image &reference) {
    require(image.width == reference.width && image.height == reference.height, "cannot compare ", image.width, " x ",
            image.height, " with ", reference.width, " x ", reference.height, " pixels");
    Sums sums;
    for (std::size_t at = 0; at < reference.pixels(); ++at) {
        if (!(reference.rgba[4 * at + 3] > 0.0f)) continue;
        ++sums.pixels;
        for (std::size_t c = 0; c < 3; ++c) sums.add(image.rgba[4 * at + c], reference.rgba[4 * at + c]);
    }
    require(sums.pixels > 0, "the reference has no pixel with alpha above 0");
    const double values = 3.0 * static_cast<double>(sums.pixels);
    return {ratio(std::sqrt(sums.difference2), std::sqrt(sums.b2), 0.0), std::sqrt(sums.difference2 / values),
            sums.max_difference, ratio(sums.a, sums.b, 1.0), sums.pixels};
}

} // namespace smx
