// smx_material_load on material files, with the report of the fit that they hold: what is read is saved, and reads back
// to the same file.
#include <numbers>

#include "files.h"
#include "memory.h"
#include "target.h"

namespace {

// Of the file's length: a bracket of an array costs nlohmann's parser some tens of bytes.
constexpr std::size_t length_factor = 100;

smx_material make_material(smx_model model, const std::vector<smx_lobe> &lobes) {
    const std::size_t sets = model == SMX_MODEL_SHARED ? 1 : lobes.size();
    const std::vector<double> theta_d{0.0, 0.7, std::numbers::pi / 2};
    std::vector<double> fresnel(sets * 3 * theta_d.size(), 0.25);
    fresnel.front() = 1e-300;
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.model = model;
    desc.lobes = lobes.data();
    desc.lobe_count = lobes.size();
    desc.theta_d = theta_d.data();
    desc.knots = theta_d.size();
    desc.fresnel = fresnel.data();
    smx_material material = nullptr;
    fuzz::require_ok(smx_material_create(&desc, &material), "a material");
    return material;
}

smx_material fitted() {
    const std::vector<double> theta{0.0, 0.2, 0.5, 1.5}, values{3.5, 1.6, 0.1, 0.0};
    smx_density density = nullptr;
    fuzz::require_ok(
        smx_density_from_samples("seed", SMX_DENSITY_NDF, theta.size(), theta.data(), values.data(), &density),
        "a density");
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.model = SMX_MODEL_SHARED;
    options.lobes = 2;
    smx_material material = nullptr;
    fuzz::require_ok(smx_material_fit(density, &options, &material), "a fit");
    smx_density_release(density);
    return material;
}

std::string saved(smx_material material) {
    static const test::TempDir dir; // not in memory alone: a save renames
    fuzz::require_ok(smx_material_save(material, (dir / "saved.json").c_str()), "a save");
    return test::read_file(dir / "saved.json");
}

} // namespace

std::vector<std::string> fuzz::seeds() {
    std::vector<std::string> files;
    for (smx_material material : {make_material(SMX_MODEL_SHARED, {{0.25, 0.1}, {0.75, 0.5}}),
                                  make_material(SMX_MODEL_PER_LOBE, {{0.5, 1e-4}, {0.5, 1e4}}), fitted()}) {
        files.push_back(saved(material));
        smx_material_release(material);
    }
    files.push_back(R"({"format": "slopemix-material", "version": 1e999})");
    files.push_back(std::string(100, '[') + std::string(100, ']'));
    return files;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static fuzz::MemoryFile file;
    file.set(data, size);
    smx_material material = nullptr, again = nullptr;
    smx_status status;
    {
        const fuzz::MemoryLimit limit(length_factor * size + fuzz::always_legal);
        status = smx_material_load(file.path().c_str(), &material);
    }
    fuzz::require_outcome(status, material, {SMX_BAD_FORMAT});
    if (!material) return 0;
    const std::string first = saved(material);
    file.set(first.data(), first.size());
    fuzz::require_ok(smx_material_load(file.path().c_str(), &again), "reading what was saved");
    fuzz::require(saved(again) == first, "a material comes back the same");
    smx_material_release(again);
    smx_material_release(material);
    return 0;
}
