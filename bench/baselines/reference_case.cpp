// The image of the reference's benchmarks.
#include "reference.h"

smx_scene reference_scene() {
    smx_scene scene = SMX_SCENE_INIT;
    scene.width = scene.height = reference_side;
    scene.light_phi = static_cast<double>(reference_light_phi);
    scene.displacement = {reference_alpha, reference_alpha, 0.0, 0.0, 0.0};
    return scene;
}

smx_status plain_table(smx_brdf brdf, std::vector<float> *table) {
    constexpr std::size_t cells = 90 * 90 * 180;
    std::vector<double> values(3 * cells);
    const smx_status status = smx_brdf_get_values(brdf, values.data(), values.size());
    table->assign(4 * cells, 0.0f);
    for (std::size_t cell = 0; cell < cells; ++cell)
        for (std::size_t c = 0; c < 3; ++c) (*table)[4 * cell + c] = static_cast<float>(values[c * cells + cell]);
    return status;
}
