#include "integrate_uniform.h"

#include "device_buffer.h"
#include "reference_attributes.h"
#include "table_whole.h"
#include "uniform_light.h"

namespace smx {

Rendered integrate_uniform(Context &context, const Brdf &brdf, const ProposalSource &source, const Scene &scene,
                           const RenderOptions &options) {
    validate(scene);
    validate_uniform(options);
    validate(options.grade, context);
    const Effects on = requested_effects(options.effects, reference_effects, "the reference", scene.masking);
    const std::vector<Lobe> proposal = options.sampler == Sampler::Mis ? source(std::nullopt) : std::vector<Lobe>{};
    const std::vector<float> table = table_whole(brdf);

    UniformImage image;
    image.start = [&](Context &device) -> UniformKernel {
        Defines defines = masking_defines(on);
        defines["GRADE"] = static_cast<int>(options.grade);
        defines["LOOKUP_NEAREST"] = options.lookup == Lookup::Nearest;
        UniformKernel own = {device.kernel("integrate_uniform.cl", "integrate_uniform", defines),
                             {buffer_from(device, table), buffer_from(device, cumulated(proposal))}};
        own.kernel.setArg(first_own_argument, own.kept[0]);
        own.kernel.setArg(first_own_argument + 1, own.kept[1]);
        own.kernel.setArg(first_own_argument + 2, static_cast<cl_int>(cumulated(proposal).size()));
        return own;
    };
    image.describe = [&](std::uint32_t spp) { return describe_reference(brdf, scene, options, on, spp); };
    Rendered rendered = render_uniform(context, scene, simplified(scene.displacement, on), options, image);
    rendered.report.effects = on;
    return rendered;
}

} // namespace smx
