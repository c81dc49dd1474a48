// What the integrators share: options, report, result.
#pragma once

#include <cstdint>
#include <functional>

#include "context.h"
#include "grade.h"
#include "image.h"
#include "scene.h"

namespace smx {

enum class Sampler { Grid = 0, Sobol = 1, Mis = 2 };
enum class Lookup { Linear = 0, Nearest = 1 };

struct RenderOptions {
    Sampler sampler = Sampler::Grid;
    std::uint32_t spp = 65536;
    std::uint64_t seed = 0;
    Lookup lookup = Lookup::Linear;
    double target_error = 0.0; // 0: spp samples; else as many as bring the standard error of the image below it
    std::function<bool(double share)> progress; // returns true to stop
    Grade grade = Grade::Precise;
};

struct RenderReport {
    double seconds = 0.0, kernel_seconds = 0.0, build_seconds = 0.0;
    std::uint64_t evaluations = 0;
    std::uint32_t spp = 0;        // drawn per pixel
    double standard_error = -1.0; // of the image, relative to its root mean square; negative: no estimate
};

struct Rendered {
    Image image;
    RenderReport report;
};

// The image is rendered in bands of whole rows, so that device memory is bounded whatever its size.
struct Band {
    std::uint32_t first_row, rows;
};
std::vector<Band> bands(const Scene &scene);

// Pixels of the largest band.
std::size_t band_pixels(const Scene &scene);

// Reads a finished band from the device into its rows of the image.
void read_band(const Context &context, const cl::Buffer &rgba, const Band &band, Image &image);

// Tells the caller how far the work is. Throws Cancelled when it is to stop.
void report_progress(const RenderOptions &options, double share);

// Measures a whole call: construct at its start, call finish() at its end.
class CallTimer {
  public:
    explicit CallTimer(const Context &context);
    RenderReport finish(const Context &context, double kernel_seconds, std::uint64_t evaluations) const;

  private:
    double start_, build_seconds_;
};

// The scene and integrator as "slopemix.*" attributes; numbers in the shortest form that reads back the same.
void describe(Image &image, const std::string &integrator, const Scene &scene);
std::string number_text(double value);

} // namespace smx
