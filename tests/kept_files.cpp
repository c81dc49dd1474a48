#include "kept_files.h"

#include <filesystem>

#include "support.h"

namespace test {

namespace {

using Json = nlohmann::ordered_json;

const float pairs_wi[][3] = {{0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}, {0.0f, -0.8f, 0.6f}, {0.48f, 0.64f, 0.6f}};
const float pairs_wo[][3] = {{0.0f, 0.0f, 1.0f}, {-0.6f, 0.0f, 0.8f}, {0.6f, 0.0f, 0.8f}, {0.0f, 0.28f, 0.96f}};
constexpr std::size_t pair_count = std::size(pairs_wi);
constexpr smx_displacement surfaces[] = {
    {0.0, 0.0, 0.0, 0.0, 0.0}, {0.25, 0.25, 0.0, 0.0, 0.0}, {0.3, 0.1, 0.4, 0.1, -0.2}};

// f cos of every pair on every surface.
Json read_fcos(smx_material material) {
    Json fcos = Json::array();
    for (const smx_displacement &surface : surfaces) {
        float rgb[pair_count][3] = {};
        EXPECT_SMX_OK(smx_material_eval(context(), material, &surface, SMX_G2_CORRELATED, nullptr, pair_count,
                                        pairs_wi[0], pairs_wo[0], rgb[0]));
        fcos.push_back(rgb);
    }
    return fcos;
}

Json read_lobes(smx_material material) {
    Json lobes = Json::array();
    for (const smx_lobe &lobe : lobes_of(material)) lobes.push_back({lobe.weight, lobe.alpha});
    return lobes;
}

// What a refined fit to a table has.
void add_details(Json &entry, smx_material material, const smx_material_info &info) {
    double theta_o[SMX_ALBEDO_ANGLES], table[SMX_ALBEDO_ANGLES][3], albedo[SMX_ALBEDO_ANGLES][3];
    if (smx_material_get_albedo(material, theta_o, table[0], albedo[0]) == SMX_OK)
        entry["albedo"] = {{"theta_o", theta_o}, {"table", table}, {"fit", albedo}};
    std::vector<double> alpha(info.lobes), curves(info.lobes * 3 * SMX_CURVE_COEFFICIENTS);
    if (smx_material_get_deviations(material, alpha.data(), curves.data(), info.lobes) == SMX_OK)
        entry["deviations"] = {{"alpha", alpha}, {"curves", curves}};
}

Json read_material(const std::string &file) {
    Material material;
    EXPECT_SMX_OK(smx_material_load(file.c_str(), material.out()));
    if (!material) return {};
    const smx_material_info info = info_of(material);
    const Curves curves = curves_of(material);
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    EXPECT_SMX_OK(smx_material_get_report(material, &report));
    Json entry = {{"name", info.name},
                  {"source", info.source},
                  {"sha256", info.sha256},
                  {"model", info.model},
                  {"lobes", read_lobes(material)},
                  {"theta_d", curves.theta_d},
                  {"fresnel", curves.fresnel},
                  {"log_likelihood", report.log_likelihood},
                  {"displaced_relrmse", report.displaced_relrmse},
                  {"choice", report.choice},
                  {"fcos", read_fcos(material)}};
    add_details(entry, material, info);
    return entry;
}

Json read_density(const std::string &file) {
    Density density;
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    EXPECT_SMX_OK(smx_density_read_csv(file.c_str(), density.out()));
    if (!density) return {};
    EXPECT_SMX_OK(smx_density_get_info(density, &info));
    std::vector<double> slope(info.nodes), p22(info.nodes);
    EXPECT_SMX_OK(smx_density_get_nodes(density, slope.data(), p22.data(), nullptr, info.nodes));
    return {{"alpha", info.alpha}, {"sha256", info.sha256}, {"slope", slope}, {"p22", p22}};
}

Json read_attributes(smx_image image) {
    Json attributes = Json::object();
    for (const char *key : {"version", "integrator", "brdf", "sampler", "spp", "seed", "alpha_x", "alpha_y", "rho",
                            "mean_slope_x", "mean_slope_y", "light_phi", "g", "lookup", "grade", "standard_error"}) {
        const char *value = smx_image_get_attribute(image, (std::string("slopemix.") + key).c_str());
        if (value) attributes[key] = value;
    }
    return attributes;
}

Json read_image(const std::string &file) {
    Image image;
    EXPECT_SMX_OK(smx_image_read_exr(file.c_str(), image.out()));
    if (!image) return {};
    const Pixels p = pixels(image);
    const std::size_t count = std::size_t{4} * p.width * p.height;
    Json entry = {{"width", p.width},
                  {"height", p.height},
                  {"rgba", std::vector<float>(p.rgba, p.rgba + count)},
                  {"attributes", read_attributes(image)}};
    if (const float *errors = smx_image_errors(image)) entry["errors"] = std::vector<float>(errors, errors + count);
    return entry;
}

} // namespace

Json read_kept_files(const std::string &folder) {
    Json files = Json::object();
    for (const auto &entry : std::filesystem::directory_iterator(folder)) {
        const std::string path = entry.path(), name = entry.path().filename(), ending = entry.path().extension();
        if (ending == ".csv") files[name] = read_density(path);
        if (ending == ".exr") files[name] = read_image(path);
        if (ending == ".json" && name != "expected.json" && name != "fits.json") files[name] = read_material(path);
    }
    return files;
}

} // namespace test
