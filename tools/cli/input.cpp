// From the words of the command line to handles of the API.
#include "input.h"

#include <filesystem>
#include <string_view>

#include "interrupt.h"

namespace slopemix::cli {

namespace {

constexpr std::string_view builtin_prefix = "builtin:";
constexpr std::string_view material_ending = ".json";

} // namespace

bool is_builtin(const std::string &input) { return input.starts_with(builtin_prefix); }
bool is_material_file(const std::string &input) { return !is_builtin(input) && input.ends_with(material_ending); }

std::string name_of(const std::string &input) {
    if (is_builtin(input)) return input.substr(builtin_prefix.size());
    return std::filesystem::path(input).stem().string();
}

Context open_context(const std::string &device) {
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    if (!device.empty()) options.device = device.c_str();
    return acquire<Context>(smx_context_create, &options);
}

Brdf open_brdf(const std::string &input) {
    stop_if_interrupted();
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

} // namespace slopemix::cli
