// The lobes of the shading benchmarks.
#include <numbers>

#include "shading.h"

ShadingCase shading_case(bool per_lobe, int count) {
    ShadingCase what{per_lobe, {}};
    const float weight = per_lobe ? 1.0f : 1.0f / static_cast<float>(count);
    for (int k = 0; k < count; ++k)
        what.lobes.push_back({weight, 0.01f + 0.99f * static_cast<float>(k) / 16.0f, {0.9f, 0.6f, 0.3f}});
    return what;
}

smx_scene shading_scene() {
    smx_scene scene = SMX_SCENE_INIT;
    scene.width = scene.height = shading_side;
    scene.light_phi = std::numbers::pi / 2;
    scene.displacement = {shading_alpha_x, shading_alpha_y, 0.0, 0.0, 0.0};
    return scene;
}

smx_status make_material(const ShadingCase &what, smx_material *material) {
    std::vector<smx_lobe> lobes;
    std::vector<double> fresnel; // [sets][rgb][2 knots]: flat
    for (const ShadingLobe &lobe : what.lobes) {
        lobes.push_back({1.0, lobe.alpha});
        if (what.per_lobe || fresnel.empty())
            for (float f : lobe.fresnel) fresnel.insert(fresnel.end(), 2, f);
    }
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.model = what.per_lobe ? SMX_MODEL_PER_LOBE : SMX_MODEL_SHARED;
    desc.lobes = lobes.data();
    desc.lobe_count = lobes.size();
    desc.knots = 2;
    desc.fresnel = fresnel.data();
    return smx_material_create(&desc, material);
}
