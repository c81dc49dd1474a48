#include "render.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

#include "error.h"

namespace smx {

namespace {

// Pixels of a band: enough to keep a device busy, 16 MB of sums in the reference.
constexpr std::uint32_t target_band_pixels = 1u << 18;

std::uint32_t band_rows(const Scene &s) { return std::clamp(target_band_pixels / s.width, 1u, s.height); }

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

} // namespace

std::vector<Band> bands(const Scene &s) {
    std::vector<Band> all;
    for (std::uint32_t row = 0; row < s.height; row += band_rows(s))
        all.push_back({row, std::min(band_rows(s), s.height - row)});
    return all;
}

std::size_t band_pixels(const Scene &s) { return std::size_t{band_rows(s)} * s.width; }

void read_band(const Context &context, const cl::Buffer &rgba, const Band &band, Image &image) {
    const std::size_t row = 4 * std::size_t{image.width};
    context.queue().enqueueReadBuffer(rgba, CL_TRUE, 0, band.rows * row * sizeof(float),
                                      image.rgba.data() + band.first_row * row);
}

void report_progress(const RenderOptions &options, double share) {
    if (options.progress && options.progress(share)) fail(Fault::Cancelled, "cancelled by the progress callback");
}

CallTimer::CallTimer(const Context &context) : start_(now()), build_seconds_(context.build_seconds()) {}

RenderReport CallTimer::finish(const Context &context, double kernel_seconds, std::uint64_t evaluations) const {
    RenderReport report;
    report.seconds = now() - start_;
    report.kernel_seconds = kernel_seconds;
    report.build_seconds = context.build_seconds() - build_seconds_;
    report.evaluations = evaluations;
    return report;
}

std::string number_text(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

void describe(Image &image, const std::string &integrator, const Scene &s) {
    auto &a = image.attributes;
    a["slopemix.version"] = SMX_LIBRARY_VERSION;
    a["slopemix.integrator"] = integrator;
    a["slopemix.light_phi"] = number_text(s.light_phi);
    a["slopemix.alpha_x"] = number_text(s.displacement.alpha_x);
    a["slopemix.alpha_y"] = number_text(s.displacement.alpha_y);
    a["slopemix.rho"] = number_text(s.displacement.rho);
    a["slopemix.mean_slope_x"] = number_text(s.displacement.mean_slope_x);
    a["slopemix.mean_slope_y"] = number_text(s.displacement.mean_slope_y);
    a["slopemix.g"] = s.masking == Masking::Separable ? "separable" : "correlated";
}

} // namespace smx
