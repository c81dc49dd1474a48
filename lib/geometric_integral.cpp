#include "geometric_integral.h"

#include <algorithm>
#include <cmath>

#include "device_buffer.h"
#include "sampling_plan.h"
#include "tile_frame.h"

namespace smx {

namespace {

// Samples of a pixel per launch, all in one window of the tile: the same for every tile of the image, so that the sums
// are, and few enough to be spread over many windows.
constexpr std::uint32_t launch_samples = 16;

} // namespace

GeometricIntegral::GeometricIntegral(Context &device, const GeometricTask &task, std::uint32_t most_rows)
    : device_(device),
      task_(task),
      table_(buffer_from(device, *task.table)),
      lobes_(buffer_from(device, cumulated(*task.proposal))) {
    const std::size_t most_pixels = std::size_t{most_rows} * task.scene->width;
    sums_ = empty_buffer<cl_float4>(device, most_pixels);
    launched_.resize(4 * most_pixels);
    added_.resize(most_pixels);
    pixels_.resize(most_pixels);
    Defines defines = masking_defines(task.effects);
    defines["UNIFORM_LIGHT"] = task.scene->light == Light::Uniform;
    defines["PATHS"] = task.has_paths();
    defines["LOOKUP_NEAREST"] = task.lookup == Lookup::Nearest;
    kernel_ = device.kernel("integrate_geometric.cl", "integrate_geometric", defines);
    kernel_.setArg(0, sums_);
    kernel_.setArg(2, to_device(*task.scene));
    kernel_.setArg(6, table_);
    kernel_.setArg(7, lobes_);
    kernel_.setArg(8, static_cast<cl_int>(cumulated(*task.proposal).size()));
    kernel_.setArg(9, static_cast<cl_int>(task.options.bounces));
}

void GeometricIntegral::begin(std::uint32_t realisation) {
    heights_ = maxima_ = cl::Buffer(); // the last one goes before the next one is drawn: there is room for one tile
    const std::shared_ptr<const HeightField> field = task_.fields->get(realisation);
    heights_ = buffer_from(device_, field->heights);
    maxima_ = buffer_from(device_, field->maxima);
    kernel_.setArg(3, tile_frame(*field, task_.scene->displacement));
    kernel_.setArg(4, heights_);
    kernel_.setArg(5, maxima_);
    kernel_.setArg(10, static_cast<cl_uint>(pass_seed(task_.seed, realisation, 0)));
    std::fill(added_.begin(), added_.end(), std::array<double, 3>{});
}

void GeometricIntegral::add_samples(const Tile &tile, std::uint32_t first) {
    const std::size_t pixels = std::size_t{tile.rows} * task_.scene->width;
    kernel_.setArg(1, static_cast<cl_int>(tile.first_row));
    kernel_.setArg(11, static_cast<cl_uint>(first / launch_samples));
    kernel_.setArg(12, static_cast<cl_uint>(first));
    kernel_.setArg(13, static_cast<cl_uint>(std::min(launch_samples, task_.samples - first)));
    seconds_ += launch(device_, kernel_, task_.scene->width, tile.rows, task_.tiling.work_group);
    read_rows(device_, sums_, pixels, launched_.data());
    for (std::size_t k = 0; k < pixels; ++k)
        for (std::size_t c = 0; c < 3; ++c) added_[k][c] += double{launched_[4 * k + c]};
}

// Takes a finished realisation, number `realisation` from 0, into means and deviations.
void GeometricIntegral::fold(std::size_t pixels, std::uint32_t realisation) {
    for (std::size_t k = 0; k < pixels; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            Pixel &p = pixels_[k];
            const double value = added_[k][c] / task_.samples;
            const double before = realisation == 0 ? 0.0 : p.mean[c],
                         squares = realisation == 0 ? 0.0 : p.deviations[c];
            p.mean[c] = before + (value - before) / (realisation + 1.0);
            p.deviations[c] = squares + (value - before) * (value - p.mean[c]);
        }
}

// Alpha is as the last launch left it; one realisation has no error to tell.
void GeometricIntegral::write(std::size_t pixels, float *rgba, float *errors) const {
    const double count = task_.options.realisations;
    const double inv_pairs = count > 1.0 ? 1.0 / (count * (count - 1.0)) : 0.0;
    for (std::size_t k = 0; k < pixels; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            rgba[4 * k + c] = static_cast<float>(pixels_[k].mean[c]);
            errors[4 * k + c] = static_cast<float>(std::sqrt(pixels_[k].deviations[c] * inv_pairs));
        }
        rgba[4 * k + 3] = errors[4 * k + 3] = launched_[4 * k + 3];
    }
}

double GeometricIntegral::integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step) {
    const double before = seconds_;
    const std::uint32_t width = task_.scene->width, realisations = task_.options.realisations;
    const std::size_t pixels = std::size_t{tile.rows} * width;
    for (std::uint32_t r = 0; r < realisations; ++r) {
        begin(r);
        for (std::uint32_t first = 0; first < task_.samples; first += launch_samples) {
            add_samples(tile, first);
            const double drawn = std::min<double>(first + double{launch_samples}, task_.samples);
            step((r + drawn / task_.samples) / realisations);
        }
        fold(pixels, r);
    }
    unkept_errors_.resize(to.errors ? 0 : 4 * pixels);
    float *errors = to.errors ? to.errors : unkept_errors_.data();
    write(pixels, to.rgba, errors);
    for (std::size_t row = 0; row < tile.rows; ++row)
        seen.set(tile.first_row + row, to.rgba + 4 * row * width, errors + 4 * row * width, width);
    return seconds_ - before;
}

} // namespace smx
