// The geometric reference on one device: launches of cl/integrate_geometric.cl for tiles of the sphere's pixels, one
// realisation after the other.
#pragma once

#include <array>
#include <vector>

#include "facet_integral.h"
#include "height_fields.h"
#include "integrate_geometric.h"

namespace smx {

// What every device is told; made once.
struct GeometricTask {
    const Scene *scene = nullptr;
    GeometricOptions options;
    Effects effects = 0;
    Lookup lookup = Lookup::Linear;
    std::uint32_t samples = 0; // of a realisation
    std::uint64_t seed = 0;
    const std::vector<float> *table = nullptr;   // table_whole.h
    const std::vector<Lobe> *proposal = nullptr; // empty where no path goes on
    HeightFields *fields = nullptr;
    Tiling tiling;
    bool has_paths() const { return options.bounces > 0 || scene->light == Light::Uniform; }
};

class GeometricIntegral {
  public:
    GeometricIntegral(Context &device, const GeometricTask &task, std::uint32_t most_rows);

    // Puts a tile's values into `to`, and their squares into `seen`. Returns the device's seconds.
    double integrate(const Tile &tile, const TileRows &to, RowErrors &seen, const Step &step);

  private:
    // A pixel's realisations so far: running mean and squared deviations (Welford 1962).
    struct Pixel {
        std::array<double, 3> mean, deviations;
    };

    void begin(std::uint32_t realisation);
    void add_samples(const Tile &tile, std::uint32_t first);
    void fold(std::size_t pixels, std::uint32_t realisation);
    void write(std::size_t pixels, float *rgba, float *errors) const;

    Context &device_;
    const GeometricTask &task_;
    cl::Kernel kernel_;
    cl::Buffer table_, lobes_, sums_, heights_, maxima_;
    std::vector<float> launched_;              // sums of one launch, RGBA
    std::vector<std::array<double, 3>> added_; // of the realisation at hand
    std::vector<Pixel> pixels_;
    std::vector<float> unkept_errors_;
    double seconds_ = 0.0;
};

} // namespace smx
