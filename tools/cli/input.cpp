// From the words of the command line to handles of the API.
#include "input.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "interrupt.h"

namespace slopemix::cli {

namespace {

constexpr std::string_view builtin_prefix = "builtin:", analytic_prefix = "analytic:", density_prefix = "density:";
constexpr std::string_view material_ending = ".json";

} // namespace

bool is_synthetic(const std::string &input) {
    return input.starts_with(builtin_prefix) || input.starts_with(analytic_prefix);
}
bool is_density(const std::string &input) { return input.starts_with(density_prefix); }
bool is_material_file(const std::string &input) { return !is_synthetic(input) && input.ends_with(material_ending); }

std::string name_of(const std::string &input) {
    if (is_density(input)) return name_of(input.substr(density_prefix.size()));
    if (!is_synthetic(input)) return std::filesystem::path(input).stem().string();
    std::string name = input.substr(input.find(':') + 1);
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

Context open_context(const RenderFlags &flags) {
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    if (!flags.device.empty()) options.device = flags.device.c_str();
    options.sub_devices = flags.sub_devices;
    return acquire<Context>(smx_context_create, &options);
}

Brdf open_brdf(const std::string &input) {
    stop_if_interrupted();
    if (is_density(input)) throw CommandError(input + " is a slope density, and a BRDF is needed here");
    return acquire<Brdf>(smx_brdf_open, input.c_str());
}

Density invert(const Brdf &brdf) {
    stop_if_interrupted();
    return acquire<Density>(smx_density_create, brdf.get(), nullptr);
}

Material fit(const Density &density, const FitFlags &flags) {
    stop_if_interrupted();
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.model = flags.model;
    options.lobes = flags.lobes;
    return acquire<Material>(smx_material_fit, density.get(), &options);
}

Density open_density(const std::string &input) {
    if (!is_density(input)) return invert(open_brdf(input));
    stop_if_interrupted();
    return acquire<Density>(smx_density_read_csv, input.c_str() + density_prefix.size());
}

FitFlags fit_flags_for(const std::string &input, FitFlags flags) {
    if (!is_density(input)) return flags;
    if (flags.model_given && flags.model != SMX_MODEL_SHARED)
        throw CLI::ValidationError("--model", std::string(word_for(flags.model, models)) + " needs a BRDF to fit its " +
                                                  "curves to, and '" + input + "' is a slope density: it takes shared");
    flags.model = SMX_MODEL_SHARED;
    return flags;
}

} // namespace slopemix::cli
