#include "draw_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "device_buffer.h"

namespace smx {

using std::numbers::pi;

namespace {

// As in cl/draw_geometry.cl.
struct Wave {
    float kx, ky, kz, amplitude, phase;
    std::int32_t kind;
};
constexpr std::int32_t solid = 0, along_theta = 1, along_phi = 2;

constexpr int waves_per_kind = 24;
constexpr double mean_frequency = 16.0; // radians per unit length: relief some 25 degrees of arc long

// Slope variance of a sum of waves is sum of (amplitude * frequency)^2 / 2 along the wave; alpha^2 is twice that.
void add_line_waves(std::vector<Wave> &waves, double alpha, std::int32_t kind, std::mt19937 &random) {
    if (alpha == 0.0) return;
    std::uniform_int_distribution<int> frequency(8, 24); // whole, so that phi closes
    std::uniform_real_distribution<double> phase(0.0, 2 * pi);
    for (int j = 0; j < waves_per_kind; ++j) {
        const double k = frequency(random), amplitude = alpha / (k * std::sqrt(double{waves_per_kind}));
        waves.push_back({static_cast<float>(k), 0.0f, 0.0f, static_cast<float>(amplitude),
                         static_cast<float>(phase(random)), kind});
    }
}

// A wave vector in space gives each tangent direction a third of its variance.
void add_solid_waves(std::vector<Wave> &waves, double alpha, std::mt19937 &random) {
    if (alpha == 0.0) return;
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> phase(0.0, 2 * pi);
    for (int j = 0; j < waves_per_kind; ++j) {
        const double x = gauss(random), y = gauss(random), z = gauss(random);
        const double scale = mean_frequency / std::sqrt(x * x + y * y + z * z);
        const double amplitude = alpha * std::sqrt(3.0 / waves_per_kind) / mean_frequency;
        waves.push_back({static_cast<float>(x * scale), static_cast<float>(y * scale), static_cast<float>(z * scale),
                         static_cast<float>(amplitude), static_cast<float>(phase(random)), solid});
    }
}

// The roughness that both axes share as solid waves, the rest along its own axis. Correlation and mean slope do not
// show in a relief and are left out.
std::vector<Wave> relief_waves(const Displacement &x) {
    std::mt19937 random(7);
    const double shared = std::min(x.alpha_x, x.alpha_y);
    std::vector<Wave> waves;
    add_solid_waves(waves, shared, random);
    add_line_waves(waves, std::sqrt((x.alpha_x - shared) * (x.alpha_x + shared)), along_theta, random);
    add_line_waves(waves, std::sqrt((x.alpha_y - shared) * (x.alpha_y + shared)), along_phi, random);
    return waves;
}

// Mean radius at which the relief, three standard deviations up, still fits the unit sphere.
double mean_radius(const std::vector<Wave> &waves) {
    double variance = 0.0;
    for (const Wave &w : waves) variance += double{w.amplitude} * w.amplitude / 2;
    return 1.0 / (1.0 + 3.0 * std::sqrt(variance));
}

RenderRows start_geometry(Context &device, std::vector<Wave> waves, const Scene &scene, const RenderOptions &options,
                          std::uint32_t most_rows) {
    const auto count = static_cast<cl_int>(waves.size());
    const auto radius = static_cast<cl_float>(mean_radius(waves));
    if (waves.empty()) waves.push_back({}); // a buffer cannot be empty
    const cl::Buffer rgba = empty_buffer<cl_float4>(device, std::size_t{most_rows} * scene.width),
                     wave_buffer = buffer_from(device, waves);
    cl::Kernel kernel = device.kernel("draw_geometry.cl", "draw_geometry");
    kernel.setArg(0, rgba);
    kernel.setArg(1, static_cast<cl_int>(scene.width));
    kernel.setArg(2, static_cast<cl_int>(scene.height));
    kernel.setArg(4, wave_buffer);
    kernel.setArg(5, count);
    kernel.setArg(6, radius);
    return [&device, &scene, &options, rgba, kernel, kept = wave_buffer](const Tile &tile, const TileRows &to,
                                                                         const Step &) mutable {
        kernel.setArg(3, static_cast<cl_int>(tile.first_row));
        const double seconds = launch(device, kernel, scene.width, tile.rows, options.tiling.work_group);
        read_rows(device, rgba, std::size_t{tile.rows} * scene.width, to.rgba);
        return seconds;
    };
}

} // namespace

Rendered draw_geometry(Context &context, const Scene &scene, const RenderOptions &options) {
    validate(scene);
    const std::vector<Wave> waves = relief_waves(scene.displacement);
    return render_once(context, scene, options, describe("geometry", scene),
                       [&](Context &device, std::uint32_t most_rows) -> RenderRows {
                           return start_geometry(device, waves, scene, options, most_rows);
                       });
}

} // namespace smx
