// smx_choose
#include "choice_constants.h"
#include "choose_configuration.h"
#include "render_arguments.h"

using namespace smx;

namespace {

smx_configuration to_c(const Configuration &c) {
    return {c.material ? static_cast<int32_t>(*c.material) : SMX_BY_REFERENCE,
            c.widening_order,
            static_cast<smx_sampler>(c.sampler),
            c.spp,
            c.error,
            c.seconds};
}

// All configurations fit where those that were tried go: the references are 13 of the grid, 25 of sobol and 24 of mis.
static_assert(SMX_MAX_TRIED >= SMX_MAX_CHOOSE_MATERIALS * choice::orders.size() + 13 + 25 + 24);

void fill(smx_choice &out, const Choice &choice) {
    out.picked = to_c(choice.picked);
    out.has_cheaper = choice.cheaper.has_value();
    if (choice.cheaper) out.cheaper = to_c(*choice.cheaper);
    out.has_better = choice.better.has_value();
    if (choice.better) out.better = to_c(*choice.better);
    out.tried_count = 0;
    for (const Configuration &c : choice.tried) out.tried[out.tried_count++] = to_c(c);
    copy_text(out.reason, choice.reason);
    out.pilot_pixels = static_cast<uint32_t>(choice.pilot_pixels);
    out.pilot_error = choice.pilot_error;
    out.device_speed = choice.device_speed;
    out.seconds = choice.cost.seconds;
    out.kernel_seconds = choice.cost.kernel_seconds;
    out.build_seconds = choice.cost.build_seconds;
}

} // namespace

extern "C" {

smx_status smx_choose(smx_context context, smx_brdf brdf, const smx_material *materials, size_t material_count,
                      const smx_scene *scene, const smx_render_options *render, const smx_choose_options *options,
                      smx_choice *choice) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(scene, "scene");
        require_pointer(options, "options");
        check_output(choice, "choice");
        require(material_count <= SMX_MAX_CHOOSE_MATERIALS, "material_count is ", material_count, "; it must be 0..",
                SMX_MAX_CHOOSE_MATERIALS);
        if (material_count > 0) require_pointer(materials, "materials");
        std::vector<std::shared_ptr<const Material>> kept;
        std::vector<const Material *> all;
        for (size_t k = 0; k < material_count; ++k) {
            require_pointer(materials[k], text("materials[", k, "]").c_str());
            kept.push_back(materials[k]->object);
            all.push_back(kept.back().get());
        }
        if (brdf) require_pointer(brdf, "brdf");
        const std::shared_ptr<const Brdf> table = brdf ? brdf->object : nullptr;
        std::optional<ChoiceTable> chosen_table;
        if (table) chosen_table.emplace(ChoiceTable{*table, proposal_of(brdf)});
        const smx_choose_options o = checked(options, SMX_CHOOSE_OPTIONS_INIT, "options");
        fill(*choice,
             choose_configuration(*context->object, chosen_table, all, to_cpp(checked(scene, smx_scene{}, "scene")),
                                  to_cpp(checked(render, SMX_RENDER_OPTIONS_INIT, "render")),
                                  {o.max_error, o.max_seconds, o.pilot_pixels}));
    });
}
}
