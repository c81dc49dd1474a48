#include "filtered_material.h"

#include <algorithm>
#include <numbers>

#include "device_buffer.h"
#include "device_lobe.h"
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

cl::Buffer lobe_buffer(const Context &context, const Material &material, const Displacement &x, Grade grade) {
    return with_real(grade,
                     [&](auto real) { return buffer_from(context, widened_lobes<decltype(real)>(material, x)); });
}

std::vector<float> packed_curves(const Material &material) {
    std::vector<float> packed;
    for (const FresnelCurves &curves : material.fresnel)
        for (const std::vector<double> &curve : curves)
            for (double f : curve) packed.push_back(static_cast<float>(f));
    return packed;
}

std::vector<float> packed_knots(const Material &material) {
    std::vector<float> knots;
    for (double angle : material.theta_d) knots.push_back(static_cast<float>(angle / (std::numbers::pi / 2)));
    return knots;
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
