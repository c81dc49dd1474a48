// What `slopemix render` is asked for and what comes out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "choose.h"
#include "flags.h"
#include "geometric_flags.h"
#include "renderings.h"
#include "scene_flags.h"

namespace slopemix::cli {

enum class Integrator { filtered, reference, geometric };
constexpr Choice<Integrator> integrators[] = {
    {"filtered", Integrator::filtered}, {"reference", Integrator::reference}, {"geometric", Integrator::geometric}};

struct RenderJob {
    std::string input, out;
    Integrator integrator = Integrator::filtered; // where `choose` is asked for: what was chosen
    ChooseFlags choose;
    SceneFlags scene;
    FitFlags fit;
    bool lobes_given = false, model_given = false;
    RenderFlags flags;
    GeometricFlags geometric;
    bool errors = false;
    bool png = false;
    bool json = false;

    bool is_filtered() const { return integrator == Integrator::filtered; }
    bool is_reference() const { return integrator == Integrator::reference; }
    bool is_geometric() const { return integrator == Integrator::geometric; }
    // By samples of a pixel: a reference, or anything under a uniform light.
    bool is_sampled() const { return !is_filtered() || scene.uniform_light; }
    // Too large to be held in memory, and not needed there.
    bool is_streamed() const {
        return !png && std::uint64_t{flags.resolution.width} * flags.resolution.height > 2048u * 2048u;
    }
    std::filesystem::path png_file() const { return std::filesystem::path(out).replace_extension(".png"); }
};

struct Rendered {
    Rendering rendering;
    std::string name;                   // of the material
    smx_model model = SMX_MODEL_SHARED; // of the filter
    std::uint32_t lobes = 0;            // of the filter
    std::string device;
    std::uint32_t devices = 1;
    double exposure = 1.0;                         // of the PNG
    std::optional<smx_effect_report> effects = {}; // of the filter: what is left out, and why
    std::optional<Chosen> chosen = {};
};

void print_json(const RenderJob &job, const Rendered &rendered);
void print_text(const RenderJob &job, const Rendered &rendered);

} // namespace slopemix::cli
