// smx_material_effects, smx_effect_name
#include "render_arguments.h"

using namespace smx;

namespace {

static_assert(SMX_EFFECT_COUNT == named_effects.size());
static_assert(SMX_EFFECTS_ALL == all_effects && SMX_EFFECTS_AUTO == auto_effects);
static_assert(static_cast<Effects>(SMX_EFFECT_INTERREFLECTION) == interreflection_effect);

} // namespace

extern "C" {

smx_status smx_material_effects(smx_material material, const smx_scene *scene, const smx_render_options *options,
                                smx_effect_report *report) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(scene, "scene");
        check_output(report, "report");
        const EffectChoice choice = material->effects->judged(
            to_cpp(checked(scene, smx_scene{}, "scene")), to_cpp(checked(options, SMX_RENDER_OPTIONS_INIT, "options")));
        smx_effect_report made = SMX_EFFECT_REPORT_INIT;
        for (std::size_t k = 0; k < choice.verdicts.size(); ++k) {
            const Verdict &v = choice.verdicts[k];
            made.verdicts[k] = {static_cast<smx_effect>(v.effect), v.supported, v.on, v.contribution, ""};
            copy_text(made.verdicts[k].reason, v.reason);
        }
        for (std::size_t k = 0; k < choice.simulated.lobes.size(); ++k) made.shaded[k] = choice.simulated.lobes[k];
        made.lobes = static_cast<uint32_t>(choice.simulated.lobes.size() - choice.dropped());
        made.left_out = choice.left_out;
        made.seconds = choice.seconds;
        *report = made;
    });
}

const char *smx_effect_name(smx_effect effect) {
    for (const NamedEffect &named : named_effects)
        if (static_cast<Effects>(effect) == named.effect) return named.name;
    return nullptr;
}
}
