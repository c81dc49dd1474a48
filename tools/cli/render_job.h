// What `slopemix render` is asked for and what comes out.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "flags.h"
#include "renderings.h"

namespace slopemix::cli {

enum class Integrator { filtered, reference };
constexpr Choice<Integrator> integrators[] = {{"filtered", Integrator::filtered}, {"reference", Integrator::reference}};

struct RenderJob {
    std::string input, out;
    Integrator integrator = Integrator::filtered;
    std::pair<double, double> alpha, mean_slope;
    double rho = 0.0;
    double light_degrees = 0.0;
    FitFlags fit;
    bool lobes_given = false, model_given = false;
    RenderFlags flags;
    bool png = false;
    bool json = false;

    smx_displacement displacement() const {
        return {alpha.first, alpha.second, rho, mean_slope.first, mean_slope.second};
    }
    bool is_reference() const { return integrator == Integrator::reference; }
    std::filesystem::path png_file() const { return std::filesystem::path(out).replace_extension(".png"); }
};

struct Rendered {
    Rendering rendering;
    std::string name;    // of the material
    smx_model model;     // of the filter
    std::uint32_t lobes; // of the filter
    std::string device;
    double exposure;
};

void print_json(const RenderJob &job, const Rendered &rendered);
void print_text(const RenderJob &job, const Rendered &rendered);

} // namespace slopemix::cli
