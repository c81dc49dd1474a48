#include "reference_attributes.h"

#include "sampling_plan.h"

namespace smx {

Attributes describe_reference(const Brdf &brdf, const Scene &scene, const RenderOptions &options, Effects on,
                              std::uint32_t spp) {
    Attributes attributes = describe("reference", scene);
    attributes["slopemix.brdf"] = brdf.name();
    attributes["slopemix.brdf_sha256"] = brdf.sha256();
    attributes["slopemix.sampler"] = sampler_name(options.sampler);
    attributes["slopemix.spp"] = std::to_string(spp);
    attributes["slopemix.scrambles"] =
        std::to_string(options.sampler == Sampler::Grid ? 1 : scrambles_of(spp, options.scrambles));
    attributes["slopemix.grade"] = grade_name(options.grade);
    attributes["slopemix.seed"] = std::to_string(options.seed);
    attributes["slopemix.lookup"] = options.lookup == Lookup::Nearest ? "nearest" : "linear";
    attributes["slopemix.effects"] = effects_text(on);
    return attributes;
}

} // namespace smx
