// The geometric reference: rays against realisations of a displaced surface.
#pragma once

#include "brdf.h"
#include "integrate_reference.h"
#include "render.h"

namespace smx {

constexpr std::uint32_t max_realisations = 65536, max_bounces = 1024;

// The surface, and how far light is followed. What else it does is the render options' effects.
struct GeometricOptions {
    std::uint32_t tile = 1024;       // cells along a side, a power of two
    std::uint32_t realisations = 16; // tiles, each with an equal share of the samples
    std::uint32_t bounces = 0;       // interreflection: facets after the first one that light may meet
};

// The sphere. options.spp samples per pixel, a multiple of the realisations, whose spread gives the standard error;
// sampler, grade and target_error have no part in it. `proposal` is asked for only where paths go on.
Rendered integrate_geometric(Context &context, const Brdf &brdf, const ProposalSource &proposal, const Scene &scene,
                             const RenderOptions &options, const GeometricOptions &geometric);

} // namespace smx
