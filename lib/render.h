// What the integrators share: options, report, result.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "canvas.h"
#include "context.h"
#include "effects.h"
#include "grade.h"
#include "image.h"
#include "scene.h"
#include "tile_queue.h"

namespace smx {

enum class Sampler { Grid = 0, Sobol = 1, Mis = 2 };
enum class Lookup { Linear = 0, Nearest = 1 };

std::string sampler_name(Sampler sampler); // "grid", "sobol", "mis"

struct RenderOptions {
    Sampler sampler = Sampler::Mis;
    std::uint32_t spp = 65536;
    std::uint64_t seed = 0;
    Lookup lookup = Lookup::Linear;
    double target_error = 0.0;         // 0: spp samples; else as many as bring the standard error of the image below it
    std::uint32_t most_spp = 1u << 24; // that a target_error may take
    std::uint32_t scrambles = 8;       // independent, of a reference: its standard errors are of their spread
    bool errors = false;               // the reference's image carries its standard errors
    bool whole_table = false;          // the reference looks the table up in whole, not cut at the image's theta_d
    std::string exr_path;              // not empty: the image goes there as it comes, and none is returned
    Tiling tiling;
    std::function<bool(double share)> progress; // returns true to stop
    Grade grade = Grade::Precise;
    int widening_order = 0;           // of filtered shading: 0..8, or widening_auto (choose_orders.h)
    double widening_tolerance = 0.02; // of widening_auto: relRMSE of the image
    Effects effects = all_effects;    // a set, all_effects or auto_effects
    double effect_tolerance = 1e-3;   // of auto_effects: relRMSE of the image
};

struct RenderReport {
    double seconds = 0.0, kernel_seconds = 0.0, build_seconds = 0.0;
    std::uint64_t evaluations = 0;
    std::uint32_t spp = 0;        // drawn per pixel
    double standard_error = -1.0; // of the image, relative to its root mean square; negative: no estimate
    std::vector<int> orders;      // of filtered shading: the widening's order of each lobe; 0 of one that is left out
    Effects effects = 0;          // simulated
    double interreflection =
        -1.0;               // of the geometric reference and auto_effects: relRMSE without it; negative: not asked
    std::size_t lobes = 0;  // of filtered shading: lobes that were shaded
    double unsettled = 0.0; // share of the lit pixels that have a lobe whose nodes were placed before they settled
};

struct Rendered {
    std::optional<Image> image;
    RenderReport report;
};

// Renders an image's tiles on all devices of a context: start(device, most rows of a tile) makes what one device does
// with a tile whose rows belong at `to`. Returns the seconds of the busiest device.
using RenderRows = std::function<double(const Tile &, const TileRows &to, const Step &)>;
using StartRows = std::function<RenderRows(Context &device, std::uint32_t most_rows)>;
double render_tiles(Context &context, const Scene &scene, const RenderOptions &options, Canvas &canvas,
                    const StartRows &start);

// One evaluation per pixel, and nothing more to it: the whole of the filtered integrator and of the geometry's picture.
Rendered render_once(Context &context, const Scene &scene, const RenderOptions &options, const Attributes &attributes,
                     const StartRows &start);

// Reads finished rows from the device.
void read_rows(const Context &device, const cl::Buffer &from, std::size_t pixels, float *to);

// Tells the caller how far the work is. Throws Cancelled when it is to stop.
void report_progress(const RenderOptions &options, double share);

// Adds the times of another part of the same call.
void add_times(RenderReport &report, const RenderReport &times);

double now_seconds(); // of a clock that never goes back

// Measures a whole call: construct at its start, call finish() at its end.
class CallTimer {
  public:
    explicit CallTimer(const Context &context);
    RenderReport finish(const Context &context, double kernel_seconds, std::uint64_t evaluations) const;

  private:
    double start_, build_seconds_;
};

// The scene and integrator as "slopemix.*" attributes; numbers in the shortest form that reads back the same.
Attributes describe(const std::string &integrator, const Scene &scene);
std::string number_text(double value);

} // namespace smx
