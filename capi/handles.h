// The handles of slopemix.h.
#pragma once

#include <mutex>
#include <vector>

#include "boundary.h"
#include "brdf.h"
#include "context.h"
#include "fit_material.h"
#include "image.h"
#include "material.h"

namespace smx {

struct DensityOfBrdf {
    std::shared_ptr<const Brdf> brdf;
    SlopeDensity density;
};

} // namespace smx

struct smx_context_s : smx::Handle<smx::Context> {
    using Handle::Handle;
};
struct smx_brdf_s : smx::Handle<const smx::Brdf> {
    using Handle::Handle;

    // The mixture that the reference's sampler mis draws from, fitted on first use.
    const std::vector<smx::Lobe> &proposal() {
        std::call_once(proposal_made_, [&] {
            smx::FitOptions options;
            options.model = smx::Model::Shared;
            proposal_ = smx::fit_material(*object, smx::invert(*object, {}), options).lobes;
        });
        return proposal_;
    }

  private:
    std::once_flag proposal_made_;
    std::vector<smx::Lobe> proposal_;
};
struct smx_density_s : smx::Handle<const smx::DensityOfBrdf> {
    using Handle::Handle;
};
struct smx_material_s : smx::Handle<const smx::Material> {
    using Handle::Handle;
};
struct smx_image_s : smx::Handle<smx::Image> {
    using Handle::Handle;
};
