// Compares the attributes of a reference with a configuration. Numbers in attributes read back exactly.
#include "existing_reference.h"

#include <map>
#include <stdexcept>

#include "flags.h"
#include "parse.h"

namespace slopemix::cli {

namespace {

using Words = std::map<std::string, std::string>;
using Numbers = std::map<std::string, double>;

Words expected_words(const std::string &sha256, const smx_scene &scene, const smx_render_options &options) {
    return {{"slopemix.version", smx_version()},
            {"slopemix.integrator", "reference"},
            {"slopemix.brdf_sha256", sha256},
            {"slopemix.g", word_for(scene.masking, maskings)},
            {"slopemix.grade", word_for(options.grade, grades)},
            {"slopemix.sampler", word_for(options.sampler, samplers)},
            {"slopemix.lookup", word_for(options.lookup, lookups)},
            {"slopemix.spp", std::to_string(options.spp)},
            {"slopemix.seed", std::to_string(options.seed)}};
}

Numbers expected_numbers(const smx_scene &scene) {
    return {{"slopemix.light_phi", scene.light_phi},
            {"slopemix.alpha_x", scene.displacement.alpha_x},
            {"slopemix.alpha_y", scene.displacement.alpha_y},
            {"slopemix.rho", scene.displacement.rho},
            {"slopemix.mean_slope_x", scene.displacement.mean_slope_x},
            {"slopemix.mean_slope_y", scene.displacement.mean_slope_y}};
}

bool is_number(const std::string &text, double value) {
    try {
        return parse_number(text, {value, value}) == value;
    } catch (const std::invalid_argument &) {
        return false;
    }
}

bool has_size(const Image &image, const smx_scene &scene) {
    std::uint32_t width = 0, height = 0;
    check(smx_image_get_size(image.get(), &width, &height));
    return width == scene.width && height == scene.height;
}

} // namespace

Image existing_reference(const std::filesystem::path &file, const std::string &sha256, const smx_scene &scene,
                         const smx_render_options &options) {
    smx_image handle = nullptr;
    if (smx_image_read_exr(file.c_str(), &handle) != SMX_OK) return nullptr;
    Image image(handle);

    const auto attribute = [&](const std::string &name) {
        const char *value = smx_image_get_attribute(handle, name.c_str());
        return std::string(value ? value : "");
    };
    // How many samples a target takes is not known before they are drawn.
    if (options.target_error > 0.0 || !has_size(image, scene)) return nullptr;
    for (const auto &[name, word] : expected_words(sha256, scene, options))
        if (attribute(name) != word) return nullptr;
    for (const auto &[name, number] : expected_numbers(scene))
        if (!is_number(attribute(name), number)) return nullptr;
    return image;
}

} // namespace slopemix::cli
