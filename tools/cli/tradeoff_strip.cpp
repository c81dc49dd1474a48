// The strip beneath the charts: a column per image, the truth last; each image above the map of its error.
#include <algorithm>
#include <cmath>

#include "exposure.h"
#include "plot.h"
#include "text.h"
#include "tradeoff_analysis.h"
#include "tradeoff_plot.h"

namespace slopemix::cli {

namespace {

constexpr std::uint32_t most_pixels = 256; // a side of a picture in the strip; larger images are thinned
constexpr double left = 0.02, side = 185.0 / page_width, gap = 12.0 / page_width;
constexpr double tall = 185.0 / page_height, image_top = 0.355, map_top = image_top - tall - 0.012;

// column, row, red, green, blue of the display, and |image - truth| as mean over the channels, relative to what is
// bright in the truth.
std::string pixels(const std::string &name, const Image &image, const Image &truth, double bright) {
    std::uint32_t width = 0, height = 0;
    check(smx_image_get_size(image.get(), &width, &height));
    std::vector<std::uint8_t> rgb(std::size_t{3} * width * height);
    check(smx_image_display(image.get(), exposure_for(bright), rgb.data(), rgb.size()));
    const float *values = smx_image_pixels(image.get()), *wanted = smx_image_pixels(truth.get());
    const std::uint32_t step = (std::max(width, height) + most_pixels - 1) / most_pixels;
    std::vector<std::vector<double>> rows;
    for (std::uint32_t y = 0; y < height; y += step)
        for (std::uint32_t x = 0; x < width; x += step) {
            const std::size_t pixel = std::size_t{y} * width + x;
            double error = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                error +=
                    std::abs(static_cast<double>(values[4 * pixel + c]) - static_cast<double>(wanted[4 * pixel + c]));
            if (!(wanted[4 * pixel + 3] > 0.0f)) error = NAN;
            rows.push_back({static_cast<double>(x / step), static_cast<double>(y / step),
                            static_cast<double>(rgb[3 * pixel]), static_cast<double>(rgb[3 * pixel + 1]),
                            static_cast<double>(rgb[3 * pixel + 2]), error / (3.0 * bright)});
        }
    return chart_data(name, rows);
}

std::string place(std::size_t column, double top) {
    const double at = left + static_cast<double>(column) * (side + gap);
    return "set lmargin at screen " + fixed(at, 5) + "\nset rmargin at screen " + fixed(at + side, 5) +
           "\nset tmargin at screen " + fixed(top, 5) + "\nset bmargin at screen " + fixed(top - tall, 5) + '\n';
}

std::string caption(std::size_t column, double at, const std::string &text) {
    return "set label 1 " + chart_text(text) + " at screen " +
           fixed(left + static_cast<double>(column) * (side + gap) + side / 2.0, 5) + ", screen " + fixed(at, 5) +
           " center noenhanced font ',11' textcolor '#333333'\n";
}

// Beneath the truth, which has no map: what the maps' colours say.
std::string colour_bar(std::size_t column) {
    const double at = left + static_cast<double>(column) * (side + gap);
    return "set colorbox horizontal user origin screen " + fixed(at, 5) + ", screen " + fixed(map_top - 0.06, 5) +
           " size screen " + fixed(side, 5) +
           ", screen 0.016\nset cbtics nomirror\n"
           "set cblabel \"|image − truth|,\\n1 being the truth’s 99th percentile\"\n";
}

std::string error_text(const TradeoffPoint &point, const GroundTruth &truth) {
    return (is_at_floor(point.measured, truth) ? "relRMSE < " : "relRMSE ") +
           general(error_bound(point.measured, truth), 2);
}

std::string time_text(double seconds) {
    return seconds < 0.1 ? general(1e3 * seconds, 2) + " ms" : general(seconds, 2) + " s";
}

} // namespace

std::string tradeoff_strip(const TradeoffResult &result) {
    const double bright = bright_value(result.truth.image);
    std::string script =
        "unset key\nunset title\nunset xlabel\nunset ylabel\nunset logscale\nunset border\nunset tics\n"
        "unset grid\nset offsets\nset xrange [*:*] noextend\nset yrange [*:*] noextend reverse\n"
        "set logscale cb\nset cbrange [1e-4:1]\nset format cb '10^{%T}'\n"
        "set palette defined (0 '#fffff5', 0.35 '#fecc5c', 0.7 '#e31a1c', 1 '#400020')\n";
    std::size_t column = 0;
    const auto picture = [&](const Image &image, const std::string &above, const std::string &beneath) {
        const std::string name = "strip" + std::to_string(column);
        script += pixels(name, image, result.truth.image, bright) + "unset colorbox\n" +
                  caption(column, image_top + 0.012, above) + place(column, image_top) + "plot $" + name +
                  " using 1:2:3:4:5 with rgbimage\n" + caption(column, map_top - tall - 0.012, beneath);
        if (column + 1 == result.strip.size()) script += colour_bar(result.strip.size());
        if (column < result.strip.size())
            script += place(column, map_top) + "plot $" + name + " using 1:2:6 with image\n";
        ++column;
    };
    for (const auto &[point, image] : result.strip)
        picture(image, name_of(point.configuration) + ", " + time_text(point.measured.kernel_seconds.median),
                error_text(point, result.truth));
    picture(result.truth.image, "truth, 2 × " + std::to_string(result.truth.samples) + " samples", "");
    return script;
}

} // namespace slopemix::cli
