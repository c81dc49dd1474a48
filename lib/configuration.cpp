#include "configuration.h"

#include <algorithm>

#include "choice_constants.h"
#include "error.h"
#include "sampling_plan.h"
#include "widening.h"

namespace smx {

namespace {

constexpr double nano = 1e-9;

double lobe_ns(const Displacement &displacement, int order) {
    const int axes = rough_axes(displacement);
    for (const choice::OrderCost &cost : choice::orders)
        if (cost.order == order && axes > 0) return axes == 1 ? cost.line_ns : cost.plane_ns;
    return choice::lobe_ns;
}

// Without roughness along two axes, nothing is drawn about wh, and a sample is one of the grid.
Sampler in_effect(const Displacement &displacement, Sampler sampler) {
    return rough_axes(displacement) == 2 ? sampler : Sampler::Grid;
}

void add_filtered(std::vector<Configuration> &all, const Material &material, std::size_t index, const Scene &scene) {
    for (const choice::OrderCost &cost : choice::orders) {
        if (cost.order > 0 && rough_axes(scene.displacement) == 0) continue;
        Configuration c;
        c.material = index;
        c.widening_order = cost.order;
        c.seconds = filtered_seconds(material, scene, cost.order);
        all.push_back(c);
    }
}

// Powers of two that the sampler takes.
void add_reference(std::vector<Configuration> &all, Sampler sampler, const Scene &scene) {
    const std::uint32_t first = sampler == Sampler::Mis ? 2 : 1, step = sampler == Sampler::Grid ? 4 : 2;
    const std::uint32_t last = rough_axes(scene.displacement) == 0 ? first : max_spp;
    for (std::uint32_t spp = first; spp <= last; spp *= step) {
        Configuration c;
        c.sampler = sampler;
        c.spp = spp;
        c.seconds = reference_seconds(scene, sampler, spp);
        all.push_back(c);
    }
}

} // namespace

double filtered_pairs_seconds(const Material &material, const Displacement &displacement, int widening_order,
                              std::size_t pairs) {
    const double ns = choice::pixel_ns + lobe_ns(displacement, widening_order) * double(material.lobes.size());
    return nano * ns * static_cast<double>(pairs);
}

double filtered_seconds(const Material &material, const Scene &scene, int widening_order) {
    return filtered_pairs_seconds(material, scene.displacement, widening_order, sphere_pixels(scene));
}

double reference_pairs_seconds(const Displacement &displacement, Sampler sampler, std::uint64_t spp,
                               std::size_t pairs) {
    const auto s = static_cast<std::size_t>(in_effect(displacement, sampler));
    return nano * static_cast<double>(spp) * (choice::facet_ns[s] + choice::sample_ns[s] * static_cast<double>(pairs));
}

double reference_seconds(const Scene &scene, Sampler sampler, std::uint64_t spp) {
    return reference_pairs_seconds(scene.displacement, sampler, spp, lit_pixels(scene));
}

std::vector<Configuration> configurations(const std::vector<const Material *> &materials, bool reference,
                                          const Scene &scene) {
    std::vector<Configuration> all;
    for (std::size_t k = 0; k < materials.size(); ++k) add_filtered(all, *materials[k], k, scene);
    if (reference && rough_axes(scene.displacement) == 0)
        add_reference(all, Sampler::Sobol, scene);
    else if (reference)
        for (const Sampler sampler : {Sampler::Grid, Sampler::Sobol, Sampler::Mis}) add_reference(all, sampler, scene);
    std::stable_sort(all.begin(), all.end(),
                     [](const Configuration &a, const Configuration &b) { return a.seconds < b.seconds; });
    return all;
}

std::string description(const Configuration &c, const std::vector<const Material *> &materials) {
    if (c.is_reference()) return text("reference, ", sampler_name(c.sampler), ", ", c.spp, " samples per pixel");
    const Material &m = *materials[*c.material];
    return text("filtered, ", model_name(m.model), ", ", m.lobes.size(), m.lobes.size() == 1 ? " lobe" : " lobes",
                ", widening order ", c.widening_order);
}

} // namespace smx
