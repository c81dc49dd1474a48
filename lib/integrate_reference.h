// Launches of cl/integrate_reference.cl: the measured table integrated over the facets of X.
#pragma once

#include "brdf.h"
#include "render.h"

namespace smx {

// options.spp samples per pixel; fewer where X has fewer dimensions than two (one sample when it has no roughness).
Rendered integrate_reference(Context &context, const Brdf &brdf, const Scene &scene, const RenderOptions &options);

}  // namespace smx
