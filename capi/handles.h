// The handles of slopemix.h.
#pragma once

#include <memory>
#include <utility>

#include "boundary.h"
#include "brdf.h"
#include "choose_effects.h"
#include "context.h"
#include "image.h"
#include "material.h"
#include "proposal.h"

namespace smx {

struct DensityOfBrdf {
    std::shared_ptr<const Brdf> brdf; // null for a density that is from samples
    SlopeDensity density;
};

} // namespace smx

struct smx_context_s : smx::Handle<smx::Context> {
    using Handle::Handle;
};
struct smx_brdf_s : smx::Handle<const smx::Brdf> {
    explicit smx_brdf_s(std::shared_ptr<const smx::Brdf> brdf)
        : Handle(brdf), proposal(std::make_shared<smx::Proposal>(std::move(brdf))) {}
    std::shared_ptr<smx::Proposal> proposal;
};
struct smx_density_s : smx::Handle<const smx::DensityOfBrdf> {
    using Handle::Handle;
};
struct smx_material_s : smx::Handle<const smx::Material> {
    explicit smx_material_s(std::shared_ptr<const smx::Material> material)
        : Handle(material), effects(std::make_shared<smx::EffectChoices>(std::move(material))) {}
    std::shared_ptr<smx::EffectChoices> effects;
};
struct smx_image_s : smx::Handle<smx::Image> {
    using Handle::Handle;
};
