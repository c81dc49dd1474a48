#include "scene_flags.h"

namespace slopemix::cli {

namespace {

constexpr NumberRange rho_range = {-1.0, 1.0}; // its ends are refused: a degenerate covariance
constexpr NumberRange mean_slope_range = {-1e4, 1e4};

double parse_rho(const std::string &text) {
    const double rho = parse_number(text, rho_range);
    if (rho == rho_range.low || rho == rho_range.high)
        throw std::invalid_argument("'" + text + "' is not between -1 and 1");
    return rho;
}

} // namespace

void add_surface_flags(CLI::App &command, SceneFlags &flags) {
    const auto pair_in = [](NumberRange range) {
        return [range](const std::string &text) { return parse_pair(text, range); };
    };
    add_parsed(command, "--alpha", flags.alpha, pair_in(alpha_range), "Roughness of the displaced surface; 0 is legal")
        ->required()
        ->type_name("AX,AY");
    add_parsed(command, "--rho", flags.rho, parse_rho, "Correlation of its two slopes, between -1 and 1 (default 0)")
        ->type_name("R");
    add_parsed(command, "--mean-slope", flags.mean_slope, pair_in(mean_slope_range), "Its mean slope (default 0,0)")
        ->type_name("MX,MY");
}

void add_light_flag(CLI::App &command, SceneFlags &flags, bool takes_uniform) {
    const auto parse_light = [&flags, takes_uniform](const std::string &text) {
        flags.uniform_light = takes_uniform && text == "uniform";
        return flags.uniform_light ? 0.0 : parse_number(text, light_range);
    };
    const std::string azimuth = "Azimuth of the light in degrees: 90 at the camera, 0 to the right, negative behind";
    const std::string uniform = "; or uniform: radiance 1 from everywhere above";
    add_parsed(command, "--light", flags.light_degrees, parse_light, takes_uniform ? azimuth + uniform : azimuth)
        ->required()
        ->type_name(takes_uniform ? "PHI_DEG|uniform" : "PHI_DEG");
}

} // namespace slopemix::cli
