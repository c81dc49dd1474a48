#include "pilot.h"

#include <cmath>
#include <limits>
#include <utility>

#include "direction_pairs.h"
#include "evaluator.h"

namespace smx {

Pilot::Pilot(Context &context, const Scene &scene, const RenderOptions &options, PilotPixels pixels)
    : context_(context),
      scene_(scene),
      options_(options),
      pixels_(std::move(pixels)),
      wi_(to_planes(pixels_.wi.data(), count(), count())),
      wo_(to_planes(pixels_.wo.data(), count(), count())) {}

PilotValues Pilot::integrate(const Brdf &brdf, const ProposalSource &proposal, const RenderOptions &options) const {
    PilotValues values;
    values.rgb.resize(3 * count());
    values.errors.resize(3 * count());
    const RenderReport report = integrate_pixels(context_, brdf, proposal, scene_, options, count(), wi_.data(),
                                                 wo_.data(), values.rgb.data(), values.errors.data());
    values.kernel_seconds = report.kernel_seconds;
    values.build_seconds = report.build_seconds;
    values.modelled_seconds =
        reference_pairs_seconds(scene_.displacement, options.sampler, report.evaluations / count(), count());
    return values;
}

PilotValues Pilot::reference(const Brdf &brdf, const ProposalSource &proposal, Sampler sampler,
                             std::uint32_t spp) const {
    RenderOptions options = options_;
    options.sampler = sampler;
    options.spp = spp;
    options.target_error = 0.0;
    return integrate(brdf, proposal, options);
}

PilotValues Pilot::truth(const Brdf &brdf, const ProposalSource &proposal, double target,
                         std::uint32_t most_spp) const {
    RenderOptions options = options_;
    options.sampler = Sampler::Mis;
    options.target_error = target;
    options.most_spp = most_spp;
    options.seed = ~options_.seed; // another image's
    return integrate(brdf, proposal, options);
}

PilotValues Pilot::filtered(const Material &material, int widening_order) const {
    RenderOptions options = options_;
    options.widening_order = widening_order;
    const double built = context_.build_seconds();
    PilotValues values;
    values.rgb.resize(3 * count());
    float *rgb = values.rgb.data();
    const float *wi = pixels_.wi.data(), *wo = pixels_.wo.data();
    Evaluator evaluator(context_, material, scene_.displacement, scene_.masking, options);
    values.kernel_seconds =
        evaluator.evaluate(Quantity::Fcos, count(),
                           {written_vectors(rgb, rgb + count(), rgb + 2 * count(), 1),
                            read_vectors(wi, wi + 1, wi + 2, 3), read_vectors(wo, wo + 1, wo + 2, 3)});
    values.build_seconds = context_.build_seconds() - built;
    values.modelled_seconds = filtered_pairs_seconds(material, scene_.displacement, widening_order, count());
    return values;
}

double Pilot::norm(const std::vector<float> &rgb) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < rgb.size(); ++k) sum += pixels_.weight[k % count()] * double{rgb[k]} * rgb[k];
    return std::sqrt(sum);
}

double Pilot::error(const PilotValues &values, const PilotValues &truth) const {
    std::vector<float> off;
    for (std::size_t k = 0; k < values.rgb.size(); ++k) off.push_back(values.rgb[k] - truth.rgb[k]);
    const double error = norm(off);
    return error == 0.0 ? 0.0 : error / norm(truth.rgb); // infinite where the truth is black
}

double Pilot::standard_error(const PilotValues &truth) const {
    const double error = norm(truth.errors);
    return error == 0.0 ? 0.0 : error / norm(truth.rgb);
}

} // namespace smx
