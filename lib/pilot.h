// What configurations look like on a pilot: on a few pixels that stand for the image (pilot_pixels.h).
#pragma once

#include "configuration.h"
#include "integrate_reference.h"
#include "pilot_pixels.h"

namespace smx {

// RGB of the pixels, [3][count], and what they took.
struct PilotValues {
    std::vector<float> rgb, errors; // standard errors, of a reference; 0 where there is no estimate
    double kernel_seconds = 0.0, build_seconds = 0.0;
    double modelled_seconds = 0.0; // of the constants' device (configuration.h)
};

class Pilot {
  public:
    // `options` as of choose_configuration.h.
    Pilot(Context &context, const Scene &scene, const RenderOptions &options, PilotPixels pixels);

    std::size_t count() const { return pixels_.count(); }

    // By so many samples, from the seed of the image that is to be made: its very facets.
    PilotValues reference(const Brdf &brdf, const ProposalSource &proposal, Sampler sampler, std::uint32_t spp) const;

    // By as many samples as bring the standard error to `target`, or by most_spp; by other facets.
    PilotValues truth(const Brdf &brdf, const ProposalSource &proposal, double target, std::uint32_t most_spp) const;

    PilotValues filtered(const Material &material, int widening_order) const;

    // relRMSE of an image, as `slopemix compare` has it: 0 where both are black, infinite where only the truth is.
    double error(const PilotValues &values, const PilotValues &truth) const;

    // The truth's own standard error, relative to it in the same way; 0 where it is exact.
    double standard_error(const PilotValues &truth) const;

  private:
    // Root of the weighted sum of squares.
    double norm(const std::vector<float> &rgb) const;
    PilotValues integrate(const Brdf &brdf, const ProposalSource &proposal, const RenderOptions &options) const;

    Context &context_;
    const Scene &scene_;
    RenderOptions options_;
    PilotPixels pixels_;
    std::vector<float> wi_, wo_; // planes
};

} // namespace smx
