#include "filtered_material.h"

#include <algorithm>

#include "widening.h"

namespace smx {

namespace {

std::string text_of(const std::vector<int> &orders) {
    std::string text;
    for (int order : orders) {
        if (!text.empty()) text += ',';
        text += std::to_string(order);
    }
    return text;
}

} // namespace

Simplified simplified(const Material &material, const Scene &scene, const Simulated &simulated) {
    Simplified s = {simplified(material, simulated.on), scene, simulated.on};
    s.scene.displacement = simplified(scene.displacement, simulated.on);
    drop_lobes(s.material, simulated.lobes);
    return s;
}

std::vector<int> with_dropped(const std::vector<int> &orders, const std::vector<bool> &kept) {
    std::vector<int> all;
    auto next = orders.begin();
    for (const bool is_kept : kept) all.push_back(is_kept ? *next++ : 0);
    return all;
}

Attributes describe_filtered(const Material &material, const Scene &scene, const RenderOptions &options,
                             const Simulated &simulated, const std::vector<int> &orders) {
    Attributes attributes = describe("filtered", scene);
    attributes["slopemix.material"] = material.name;
    attributes["slopemix.model"] = model_name(material.model);
    attributes["slopemix.grade"] = grade_name(options.grade);
    attributes["slopemix.lobes"] = std::to_string(material.lobes.size());
    attributes["slopemix.widening_order"] =
        options.widening_order == widening_auto ? "auto" : std::to_string(options.widening_order);
    attributes["slopemix.widening_orders"] = text_of(orders);
    if (options.widening_order == widening_auto)
        attributes["slopemix.widening_tolerance"] = number_text(options.widening_tolerance);
    attributes["slopemix.effects"] = effects_text(simulated.on);
    attributes["slopemix.lobes_shaded"] =
        std::to_string(std::count(simulated.lobes.begin(), simulated.lobes.end(), true));
    return attributes;
}

} // namespace smx
