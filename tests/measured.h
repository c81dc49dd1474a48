// The experiment on a measured material: how far filtered images are from their references.
#pragma once

#include <vector>

#include "support.h"

namespace test {

struct Experiment {
    uint32_t size = 32, spp = 1024;
    std::vector<smx_displacement> displacements;
    std::vector<double> lights_deg{90.0, 0.0, -25.0};
};

// Mean relRMSE over the experiment's images for each number of lobes.
inline std::vector<double> mean_errors(smx_brdf brdf, const Experiment &e, const std::vector<uint32_t> &lobes,
                                       smx_model model) {
    const Density density = make_density(brdf, SMX_MASKING_COINCIDES);
    std::vector<Material> materials;
    for (const uint32_t count : lobes) materials.push_back(fit(density, count, model));
    std::vector<double> means(lobes.size());
    const double images = static_cast<double>(e.displacements.size() * e.lights_deg.size());
    for (const smx_displacement &x : e.displacements)
        for (const double light : e.lights_deg) {
            const smx_scene scene = make_scene(e.size, e.size, radians(light), x);
            const Image reference = render_reference(brdf, scene, make_options(e.spp));
            for (std::size_t k = 0; k < lobes.size(); ++k)
                means[k] += relrmse(render_filtered(materials[k], scene), reference) / images;
        }
    return means;
}

} // namespace test
