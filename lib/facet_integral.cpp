#include "facet_integral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf.h"
#include "device_buffer.h"
#include "device_estimate.h"

namespace smx {

namespace {

constexpr const char *kernel_file = "integrate_reference.cl", *drawing_file = "draw_facets.cl";

constexpr std::size_t planes_of_x = 5, planes_about_wh = 4; // that draw_facets.cl writes

std::size_t facets_of(const std::vector<Part> &parts) {
    const Part &largest = parts.front();
    return static_cast<std::size_t>(largest.scrambles) * static_cast<std::size_t>(largest.slots);
}

// By pass, of every scramble.
std::vector<cl::Buffer> seeds_of(const Context &device, const SamplingPlan &plan, std::uint64_t seed) {
    std::vector<cl::Buffer> buffers;
    for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
        std::vector<cl_uint> seeds;
        for (std::uint32_t s = 0; s < plan.scrambles; ++s) seeds.push_back(pass_seed(seed, s, pass));
        buffers.push_back(buffer_from(device, seeds));
    }
    return buffers;
}

// The image's theta_d in rows of the whole table.
template <typename Real>
Real table_row(const Scene &scene) {
    return static_cast<Real>(theta_d(scene) / (std::numbers::pi / 2) * Brdf::theta_d_count);
}

cl::Buffer plane_buffer(const Context &device, const std::vector<float> *planes) {
    return planes ? buffer_from(device, *planes) : cl::Buffer();
}

} // namespace

void RowErrors::set(std::size_t row, const float *rgba, const float *errors, std::size_t items) {
    double value2 = 0.0, error2 = 0.0;
    for (std::size_t at = 0; at < 4 * items; ++at) {
        if (at % 4 == 3) continue;
        value2 += double{rgba[at]} * rgba[at];
        error2 += double{errors[at]} * errors[at];
    }
    values2_[row] = value2;
    errors2_[row] = error2;
}

double RowErrors::relative() const {
    double value2 = 0.0, error2 = 0.0;
    for (double v : values2_) value2 += v;
    for (double e : errors2_) error2 += e;
    return error2 == 0.0 ? 0.0 : std::sqrt(error2 / value2);
}

FacetIntegral::FacetIntegral(Context &device, const IntegralTask &task, std::uint32_t most_rows)
    : device_(device),
      task_(task),
      parts_(sampling_parts(task.plan, std::size_t{most_rows} * task.row_items, device.width(), task.tiling.facets)),
      most_items_(std::size_t{most_rows} * task.row_items),
      stride_(static_cast<std::uint32_t>(round_up(facets_of(parts_), device.width()))),
      of_x_(empty_buffer<float>(device, planes_of_x * stride_)),
      about_wh_(empty_buffer<float>(device, task.plan.passes.size() > 1 ? planes_about_wh * stride_ : 1)),
      table_(buffer_from(device, *task.table)),
      lobes_(buffer_from(device, cumulated(*task.proposal))),
      density_(buffer_from(device, proposal_table(*task.proposal))),
      estimates_(empty_buffer<DeviceEstimate>(device, parts_.size() > 1 ? most_items_ : 1)),
      rgba_(empty_buffer<cl_float4>(device, most_items_)),
      errors_(empty_buffer<cl_float4>(device, most_items_)),
      wi_(plane_buffer(device, task.pairs ? &task.pairs->wi : nullptr)),
      wo_(plane_buffer(device, task.pairs ? &task.pairs->wo : nullptr)),
      seeds_(seeds_of(device, task.plan, task.seed)),
      integrate_(integrating_kernel()) {
    for (std::size_t pass = 0; pass < task.plan.passes.size(); ++pass) {
        const cl::Buffer &facets = pass == 0 ? of_x_ : about_wh_;
        draw_.push_back(drawing_kernel(pass, facets));
        // Empty slots are computed and dropped, so what is read there must be numbers.
        device.queue().enqueueFillBuffer(facets, 0.0f, 0, facets.getInfo<CL_MEM_SIZE>());
    }
}

cl::Kernel FacetIntegral::drawing_kernel(std::size_t index, const cl::Buffer &facets) {
    const Pass &pass = task_.plan.passes[index];
    const char *names[] = {"draw_grid", "draw_sobol", "draw_about_z"};
    cl::Kernel kernel = device_.kernel(drawing_file, names[static_cast<int>(pass.drawing)]);
    kernel.setArg(0, facets);
    kernel.setArg(1, static_cast<cl_int>(stride_));
    kernel.setArg(3, seeds_[index]);
    if (pass.drawing == Drawing::AboutZ) {
        kernel.setArg(4, lobes_);
        kernel.setArg(5, static_cast<cl_int>(cumulated(*task_.proposal).size()));
        kernel.setArg(6, density_);
    } else {
        kernel.setArg(4, to_device(task_.displacement));
    }
    if (pass.drawing == Drawing::Grid) {
        kernel.setArg(5, static_cast<cl_uint>(pass.strata_1));
        kernel.setArg(6, static_cast<cl_uint>(pass.strata_2));
    }
    return kernel;
}

cl::Kernel FacetIntegral::integrating_kernel() {
    Defines defines = masking_defines(task_.effects);
    defines["GRADE"] = static_cast<int>(task_.grade);
    defines["LOOKUP_NEAREST"] = task_.lookup == Lookup::Nearest;
    defines["TABLE_WHOLE"] = task_.whole_table;
    defines["BALANCED"] = task_.plan.passes.size() > 1;
    defines["SLICE_SUMS"] = static_cast<int>(scrambles_per_vector(task_.plan, device_.width()));
    cl::Kernel kernel = device_.kernel(kernel_file, task_.scene ? "integrate_sphere" : "integrate_pairs", defines);
    kernel.setArg(0, rgba_);
    kernel.setArg(1, errors_);
    kernel.setArg(2, estimates_);
    set_arg(kernel, 4, task_.displacement, task_.grade);
    kernel.setArg(5, table_);
    kernel.setArg(6, density_);
    kernel.setArg(7, of_x_);
    kernel.setArg(8, about_wh_);
    kernel.setArg(9, static_cast<cl_int>(stride_));
    if (task_.scene) {
        set_arg(kernel, 11, *task_.scene, task_.grade);
        with_real(task_.grade, [&](auto real) { kernel.setArg(12, table_row<decltype(real)>(*task_.scene)); });
    } else {
        kernel.setArg(12, wi_);
        kernel.setArg(13, wo_);
        kernel.setArg(14, static_cast<cl_int>(task_.pairs->stride));
    }
    return kernel;
}

void FacetIntegral::draw(const Part &part) {
    if (drawn_) return;
    for (cl::Kernel &kernel : draw_) {
        kernel.setArg(2, part);
        seconds_ +=
            launch(device_, kernel, static_cast<std::size_t>(part.scrambles) * part.slots, 1, task_.tiling.work_group);
    }
    drawn_ = parts_.size() == 1;
}

void FacetIntegral::add(const Part &part, const Tile &tile) {
    const std::size_t lanes = device_.width();
    integrate_.setArg(3, part);
    integrate_.setArg(10, static_cast<cl_int>(tile.first_row));
    if (!task_.scene) integrate_.setArg(11, static_cast<cl_int>(tile.rows));
    const std::size_t columns = task_.scene ? task_.row_items : tile.rows, rows = task_.scene ? tile.rows : 1;
    // A work-item of several pixels has work enough to be a group of its own.
    const std::uint32_t group = task_.tiling.work_group || lanes == 1 ? task_.tiling.work_group : 1;
    seconds_ += launch(device_, integrate_, round_up(columns, lanes) / lanes, rows, group);
}

double FacetIntegral::integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step) {
    const std::size_t row_items = task_.row_items, items = tile.rows * row_items;
    const double before = seconds_;
    double done = 0.0;
    for (const Part &part : parts_) {
        draw(part);
        add(part, tile);
        done += static_cast<double>(part.scrambles) * part.size;
        step(std::min(done / task_.plan.scrambles / task_.plan.passes[0].samples, 1.0));
    }

    unkept_errors_.resize(to.errors ? 0 : 4 * items);
    float *errors = to.errors ? to.errors : unkept_errors_.data();
    read_rows(device_, rgba_, items, to.rgba);
    read_rows(device_, errors_, items, errors);
    for (std::size_t row = 0; row < tile.rows; ++row)
        seen.set(tile.first_row + row, to.rgba + 4 * row * row_items, errors + 4 * row * row_items, row_items);
    return seconds_ - before;
}

} // namespace smx
