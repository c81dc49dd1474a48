// The statistical reference: the measured table integrated over the facets of X.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "brdf.h"
#include "material.h"
#include "render.h"

namespace smx {

// The mixture that Sampler::Mis draws from about the half vector, at a theta_d or, without one, for all of them. Empty
// where nothing is reflected.
using ProposalSource = std::function<const std::vector<Lobe> &(std::optional<double> theta_d)>;

// The sphere. options.spp samples per pixel, or as many as options.target_error needs. Where X has roughness along one
// axis only, all samples go along it; where it has none, one is exact. `proposal` is asked for only where it is drawn
// from.
Rendered integrate_reference(Context &context, const Brdf &brdf, const ProposalSource &proposal, const Scene &scene,
                             const RenderOptions &options);

// The same for `count` pairs of directions, with the whole table: f cos and, unless null, its standard errors. All
// arrays are planes, [3][count]. 0 where either direction is not above the surface.
RenderReport integrate_pairs(Context &context, const Brdf &brdf, const ProposalSource &proposal,
                             const Displacement &displacement, Masking masking, const RenderOptions &options,
                             std::size_t count, const float *wi, const float *wo, float *fcos, float *errors);

// `count` > 0 lit pixels of the sphere, by the facets that integrate_reference gives its image; planes, as there. The
// scene is valid and has a directional light.
RenderReport integrate_pixels(Context &context, const Brdf &brdf, const ProposalSource &proposal, const Scene &scene,
                              const RenderOptions &options, std::size_t count, const float *wi, const float *wo,
                              float *fcos, float *errors);

} // namespace smx
