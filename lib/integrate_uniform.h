// The statistical reference under a uniform light: one launch function for cl/integrate_uniform.cl.
#pragma once

#include "integrate_reference.h"

namespace smx {

// The sphere, as integrate_reference has it, of a scene with a uniform light. Sampler::Mis draws directions from the
// table's mixture about a facet; Sampler::Sobol from a wide lobe and the cosine, whatever the table is.
Rendered integrate_uniform(Context &context, const Brdf &brdf, const ProposalSource &proposal, const Scene &scene,
                           const RenderOptions &options);

} // namespace smx
