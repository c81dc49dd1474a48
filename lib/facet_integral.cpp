#include "facet_integral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf.h"
#include "device_buffer.h"

namespace smx {

namespace {

constexpr const char *kernel_file = "integrate_reference.cl", *drawing_file = "draw_facets.cl";

// Facets drawn and integrated per launch: a whole number of the kernel's summation blocks, so that the sums do not
// depend on it, and few enough that progress is told and a cancel heard several times a second.
constexpr std::uint32_t summation_block = 256;
constexpr std::uint64_t launch_evaluations = 1u << 26;
constexpr std::size_t facet_planes = 5; // the most that draw_facets.cl writes
constexpr std::size_t pair_reals = 21;  // of a Pair in cl/facet_integral.clh

std::uint32_t facets_per_launch(std::size_t items, const SamplingPlan &plan) {
    const std::uint64_t wanted = launch_evaluations / items / summation_block * summation_block;
    const std::uint64_t most = std::clamp<std::uint64_t>(wanted, summation_block, 1u << 18);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(most, plan.samples_per_scramble()));
}

// The image's theta_d in rows of the whole table.
template <typename Real>
Real table_row(const Scene &scene) {
    return static_cast<Real>(theta_d(scene) / (std::numbers::pi / 2) * Brdf::theta_d_count);
}

cl::Buffer buffer_of_reals(const Context &device, Grade grade, std::size_t count) {
    return with_real(grade, [&](auto real) { return empty_buffer<decltype(real)>(device, count); });
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
      most_items_(std::size_t{most_rows} * task.row_items),
      per_launch_(facets_per_launch(most_items_, task.plan)),
      stride_(static_cast<std::uint32_t>(round_up(per_launch_, device.width()))),
      facets_(empty_buffer<float>(device, facet_planes * stride_)),
      pairs_(buffer_of_reals(device, task.grade, pair_reals * most_items_)),
      table_(buffer_from(device, *task.table)),
      lobes_(buffer_from(device, cumulated(*task.proposal))),
      density_(buffer_from(device, proposal_table(*task.proposal))),
      sums_(empty_buffer<cl_float4>(device, most_items_)),
      rests_(empty_buffer<cl_float4>(device, most_items_)),
      means_(empty_buffer<cl_float4>(device, most_items_)),
      deviations_(empty_buffer<cl_float4>(device, most_items_)),
      rgba_(empty_buffer<cl_float4>(device, most_items_)),
      errors_(empty_buffer<cl_float4>(device, most_items_)),
      wi_(plane_buffer(device, task.pairs ? &task.pairs->wi : nullptr)),
      wo_(plane_buffer(device, task.pairs ? &task.pairs->wo : nullptr)) {
    const Defines defines = {{"GRADE", static_cast<int>(task.grade)},
                             {"G2_SEPARABLE", task.masking == Masking::Separable},
                             {"LOOKUP_NEAREST", task.lookup == Lookup::Nearest},
                             {"TABLE_WHOLE", task.whole_table}};
    for (const Pass &pass : task.plan.passes)
        passes_.push_back({drawing_kernel(pass), integrating_kernel(pass, defines)});
    make_outer_kernels(defines);
    // Lanes past the last facet are computed and dropped, so what they read must be numbers.
    device.queue().enqueueFillBuffer(facets_, 0.0f, 0, facet_planes * stride_ * sizeof(float));
    device.queue().enqueueFillBuffer(sums_, 0.0f, 0, most_items_ * sizeof(cl_float4));
    device.queue().enqueueFillBuffer(rests_, 0.0f, 0, most_items_ * sizeof(cl_float4));
}

cl::Kernel FacetIntegral::drawing_kernel(const Pass &pass) {
    const char *names[] = {"draw_grid", "draw_sobol", "draw_about_z"};
    cl::Kernel kernel = device_.kernel(drawing_file, names[static_cast<int>(pass.drawing)]);
    kernel.setArg(0, facets_);
    kernel.setArg(1, static_cast<cl_int>(stride_));
    if (pass.drawing == Drawing::AboutZ) {
        kernel.setArg(5, lobes_);
        kernel.setArg(6, static_cast<cl_int>(task_.proposal->size()));
        kernel.setArg(7, density_);
    } else {
        kernel.setArg(5, to_device(task_.displacement));
    }
    if (pass.drawing == Drawing::Grid) {
        kernel.setArg(6, static_cast<cl_uint>(pass.strata_1));
        kernel.setArg(7, static_cast<cl_uint>(pass.strata_2));
    }
    return kernel;
}

cl::Kernel FacetIntegral::integrating_kernel(const Pass &pass, Defines defines) {
    defines["TECHNIQUE"] = static_cast<int>(pass.technique);
    cl::Kernel kernel = device_.kernel(kernel_file, "integrate_reference", defines);
    kernel.setArg(0, sums_);
    kernel.setArg(1, rests_);
    kernel.setArg(2, pairs_);
    set_arg(kernel, 4, task_.displacement, task_.grade);
    kernel.setArg(5, table_);
    kernel.setArg(6, density_);
    kernel.setArg(7, facets_);
    kernel.setArg(8, static_cast<cl_int>(stride_));
    return kernel;
}

// What comes before and after the samples.
void FacetIntegral::make_outer_kernels(Defines defines) {
    defines["TECHNIQUE"] = static_cast<int>(task_.plan.passes[0].technique); // any that is built already
    prepare_ = device_.kernel(kernel_file, task_.scene ? "prepare_sphere" : "prepare_pairs", defines);
    prepare_.setArg(0, pairs_);
    set_arg(prepare_, 2, task_.displacement, task_.grade);
    if (task_.scene) {
        set_arg(prepare_, 3, *task_.scene, task_.grade);
        with_real(task_.grade, [&](auto real) { prepare_.setArg(4, table_row<decltype(real)>(*task_.scene)); });
    } else {
        prepare_.setArg(4, wi_);
        prepare_.setArg(5, wo_);
        prepare_.setArg(6, static_cast<cl_int>(task_.pairs->stride));
    }

    fold_ = device_.kernel(kernel_file, "fold_scramble", defines);
    fold_.setArg(0, sums_);
    fold_.setArg(1, rests_);
    fold_.setArg(2, means_);
    fold_.setArg(3, deviations_);
    fold_.setArg(4, 1.0f / static_cast<float>(task_.plan.samples_per_scramble()));

    finish_ = device_.kernel(kernel_file, "finish_reference", defines);
    finish_.setArg(0, rgba_);
    finish_.setArg(1, errors_);
    finish_.setArg(2, means_);
    finish_.setArg(3, deviations_);
    finish_.setArg(4, pairs_);
    finish_.setArg(6, static_cast<cl_int>(task_.plan.scrambles));
}

void FacetIntegral::run(const cl::Kernel &kernel, std::size_t columns, std::size_t rows) {
    seconds_ += launch(device_, kernel, columns, rows, task_.tiling.work_group);
}

void FacetIntegral::prepare(const Tile &tile) {
    const std::size_t lanes = device_.width();
    prepare_.setArg(1, static_cast<cl_int>(tile.first_row));
    if (task_.scene) {
        run(prepare_, round_up(task_.row_items, lanes) / lanes, tile.rows);
    } else {
        prepare_.setArg(3, static_cast<cl_int>(tile.rows));
        run(prepare_, round_up(tile.rows, lanes) / lanes);
    }
}

void FacetIntegral::run_pass(std::size_t index, std::uint32_t scramble, std::size_t items,
                             const std::function<void(std::uint32_t)> &done) {
    const std::uint32_t samples = task_.plan.passes[index].samples;
    PassKernels &kernels = passes_[index];
    for (std::uint32_t first = 0; first < samples; first += per_launch_) {
        const std::uint32_t size = std::min(per_launch_, samples - first);
        kernels.draw.setArg(2, static_cast<cl_uint>(first));
        kernels.draw.setArg(3, static_cast<cl_uint>(size));
        kernels.draw.setArg(4, static_cast<cl_uint>(pass_seed(task_.seed, scramble, index)));
        run(kernels.draw, size);
        kernels.integrate.setArg(3, static_cast<cl_int>(items));
        kernels.integrate.setArg(9, static_cast<cl_int>(size));
        run(kernels.integrate, items);
        done(size);
    }
}

double FacetIntegral::integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step) {
    const std::size_t row_items = task_.row_items, items = tile.rows * row_items;
    const double before = seconds_;
    prepare(tile);
    std::uint64_t drawn = 0;
    for (std::uint32_t scramble = 0; scramble < task_.plan.scrambles; ++scramble) {
        for (std::size_t pass = 0; pass < passes_.size(); ++pass)
            run_pass(pass, scramble, items, [&](std::uint32_t size) {
                drawn += size;
                step(static_cast<double>(drawn) / task_.plan.samples());
            });
        fold_.setArg(5, static_cast<cl_int>(items));
        fold_.setArg(6, static_cast<cl_int>(scramble + 1));
        run(fold_, items);
    }
    finish_.setArg(5, static_cast<cl_int>(items));
    run(finish_, items);

    unkept_errors_.resize(to.errors ? 0 : 4 * items);
    float *errors = to.errors ? to.errors : unkept_errors_.data();
    read_rows(device_, rgba_, items, to.rgba);
    read_rows(device_, errors_, items, errors);
    for (std::size_t row = 0; row < tile.rows; ++row)
        seen.set(tile.first_row + row, to.rgba + 4 * row * row_items, errors + 4 * row * row_items, row_items);
    return seconds_ - before;
}

} // namespace smx
