// Images under a uniform light: per pixel the integral over all light, by samples of the filter (cl/shade_uniform.cl)
// or of the statistical reference (cl/integrate_uniform.cl).
#pragma once

#include <functional>
#include <vector>

#include "facet_integral.h"
#include "render.h"
#include "sampling_plan.h"

namespace smx {

// A kernel with the arguments that are its integrator's own, and what must live as long.
struct UniformKernel {
    cl::Kernel kernel;
    std::vector<cl::Buffer> kept;
};

// The first argument that is not the same for all of them: before it come pixels, errors, estimates, part, seeds, first
// row, view and X.
constexpr cl_uint first_own_argument = 8;

// What every device is told.
struct UniformTask {
    Scene scene; // with X as it is simulated
    SamplingPlan plan;
    std::uint64_t seed = 0;
    Grade grade = Grade::Precise;
    Tiling tiling;
};

class UniformIntegral {
  public:
    UniformIntegral(Context &device, const UniformTask &task, std::uint32_t most_rows, UniformKernel own);

    // Puts a tile's values into `to`, and their squares into `seen`. Returns the device's seconds.
    double integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step);

  private:
    Context &device_;
    const UniformTask &task_;
    UniformKernel own_;
    cl::Buffer rgba_, errors_, estimates_, seeds_;
    std::vector<float> unkept_errors_;
};

// The whole of such an image: as many samples as the options ask for. `start` makes a device's kernel; after a tile
// `finish_tile`, which may be empty, is called in the device's thread. `describe` has the attributes for a number of
// samples.
struct UniformImage {
    std::function<UniformKernel(Context &device)> start;
    std::function<void(Context &device, const UniformKernel &)> finish_tile;
    std::function<Attributes(std::uint32_t spp)> describe;
};
Rendered render_uniform(Context &context, const Scene &scene, const Displacement &simulated,
                        const RenderOptions &options, const UniformImage &image);

// Throws InvalidArgument for samples that a uniform light does not have: the grid's.
void validate_uniform(const RenderOptions &options);

} // namespace smx
