#include "draw_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "device_buffer.h"
#include "height_field.h"

namespace smx {

namespace {

// As in cl/draw_geometry.cl.
struct Relief {
    float shared, along_theta, along_phi;
    float cells_per_radian;
    std::int32_t log2_side;
    float radius;
};

// A tile of 512 cells goes once around the sphere and is not met again: bumps are some 25 degrees of arc apart.
constexpr std::uint32_t log2_side = 9;
constexpr double cells_per_radian = 512 / (2 * std::numbers::pi);
constexpr std::uint64_t picture_seed = 7;

// The roughness that both axes share is a plane of the tile, the rest a line along its own axis. Correlation and mean
// slope do not show in a relief and are left out.
Relief relief_of(const Displacement &x) {
    const double shared = std::min(x.alpha_x, x.alpha_y);
    const auto beyond = [&](double alpha) { return std::sqrt((alpha - shared) * (alpha + shared)); };
    // Three standard deviations of the height, which is the slope's by the correlation length, fit the unit sphere.
    const double alpha = std::max(x.alpha_x, x.alpha_y);
    const double deviation = alpha / std::numbers::sqrt2 * correlation_length / cells_per_radian;
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(shared),
            f(beyond(x.alpha_x)),
            f(beyond(x.alpha_y)),
            f(cells_per_radian),
            static_cast<std::int32_t>(log2_side),
            f(1.0 / (1.0 + 3.0 * deviation))};
}

RenderRows start_geometry(Context &device, const HeightField &field, const Scene &scene, const RenderOptions &options,
                          std::uint32_t most_rows) {
    const cl::Buffer rgba = empty_buffer<cl_float4>(device, std::size_t{most_rows} * scene.width),
                     heights = buffer_from(device, field.heights);
    cl::Kernel kernel = device.kernel("draw_geometry.cl", "draw_geometry");
    kernel.setArg(0, rgba);
    kernel.setArg(1, static_cast<cl_int>(scene.width));
    kernel.setArg(2, static_cast<cl_int>(scene.height));
    kernel.setArg(4, relief_of(scene.displacement));
    kernel.setArg(5, heights);
    return [&device, &scene, &options, rgba, kernel, kept = heights](const Tile &tile, const TileRows &to,
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
    const HeightField field = make_height_fields(log2_side, picture_seed)[0];
    return render_once(context, scene, options, describe("geometry", scene),
                       [&](Context &device, std::uint32_t most_rows) -> RenderRows {
                           return start_geometry(device, field, scene, options, most_rows);
                       });
}

} // namespace smx
