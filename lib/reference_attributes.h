// What a statistical reference's image says of itself.
#pragma once

#include "brdf.h"
#include "render.h"

namespace smx {

Attributes describe_reference(const Brdf &brdf, const Scene &scene, const RenderOptions &options, Effects on,
                              std::uint32_t spp);

} // namespace smx
