// The reference's integral on one device: launches of cl/draw_facets.cl and cl/integrate_reference.cl for tiles of the
// sphere's pixels or of pairs of directions.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "material.h"
#include "render.h"
#include "sampling_parts.h"

namespace smx {

// Pairs of directions as planes, [3][stride], padded by a device's lanes (direction_pairs.h).
struct PairPlanes {
    std::size_t stride;
    std::vector<float> wi, wo;
};

// What every device of an integration is told; made once. One of `scene` and `pairs` is there.
struct IntegralTask {
    const Scene *scene = nullptr;
    const PairPlanes *pairs = nullptr;
    Displacement displacement;
    Effects effects = 0; // of what hides facets
    Lookup lookup = Lookup::Linear;
    bool whole_table = false;
    const std::vector<float> *table = nullptr;   // table_slice.h or table_whole.h
    const std::vector<Lobe> *proposal = nullptr; // empty where nothing is drawn from it
    SamplingPlan plan;
    std::uint64_t seed = 0;
    Grade grade = Grade::Precise;
    Tiling tiling;
    std::uint32_t row_items = 0; // pixels of a row; 1 for pairs
};

// Squares of values and of their standard errors, row by row: their sum does not depend on the tiling.
class RowErrors {
  public:
    explicit RowErrors(std::size_t rows) : values2_(rows), errors2_(rows) {}
    void set(std::size_t row, const float *rgba, const float *errors, std::size_t items);
    double relative() const; // root mean square error over root mean square value; 0 where there is no error

  private:
    std::vector<double> values2_, errors2_;
};

class FacetIntegral {
  public:
    FacetIntegral(Context &device, const IntegralTask &task, std::uint32_t most_rows);

    // Puts a tile's values into `to`, and their squares into `seen`. Returns the device's seconds.
    double integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step);

  private:
    cl::Kernel drawing_kernel(std::size_t pass, const cl::Buffer &facets);
    cl::Kernel integrating_kernel();
    void draw(const Part &part);
    void add(const Part &part, const Tile &tile);

    Context &device_;
    const IntegralTask &task_;
    std::vector<Part> parts_;
    std::size_t most_items_;
    std::uint32_t stride_;
    cl::Buffer of_x_, about_wh_, table_, lobes_, density_, estimates_, rgba_, errors_, wi_, wo_;
    std::vector<cl::Buffer> seeds_; // by pass
    std::vector<cl::Kernel> draw_;  // by pass
    cl::Kernel integrate_;
    bool drawn_ = false; // all facets lie in their buffers
    std::vector<float> unkept_errors_;
    double seconds_ = 0.0;
};

} // namespace smx
