#include "ground_truth.h"

#include <algorithm>
#include <cmath>

#include "renderings.h"
#include "run_statistics.h"

namespace slopemix::cli {

namespace {

constexpr std::uint64_t apart = 1ull << 32; // from the seeds of the runs that are measured

} // namespace

smx_comparison compare(const Image &image, const Image &reference) {
    smx_comparison comparison = SMX_COMPARISON_INIT;
    check(smx_image_compare(image.get(), reference.get(), &comparison));
    return comparison;
}

void measure_scale(GroundTruth &truth, const std::string &what) {
    std::uint32_t width = 0, height = 0;
    check(smx_image_get_size(truth.image.get(), &width, &height));
    const Image black = acquire<Image>(smx_image_create, width, height, static_cast<const float *>(nullptr));
    truth.rms = compare(black, truth.image).rmse;
    check(smx_image_quantile(truth.image.get(), 1.0, &truth.peak));
    if (!(truth.rms > 0.0))
        throw CommandError("the reference of " + what +
                           " is black: no light is in view, and a black image has no relative error; turn --light "
                           "towards the camera, which is at 90 degrees");
}

GroundTruth ground_truth(const Context &context, const Brdf &brdf, const smx_scene &scene,
                         const smx_render_options &options, const std::string &what) {
    smx_render_options other = options;
    other.seed = options.seed + apart;
    const Rendering first = render_reference(context, brdf, scene, other);
    ++other.seed;
    const Rendering second = render_reference(context, brdf, scene, other);
    RunStatistics both;
    both.add(first.image);
    both.add(second.image);

    GroundTruth truth;
    truth.image = both.mean();
    truth.samples = first.report.spp;
    measure_scale(truth, what);
    const double expected = std::hypot(first.report.standard_error, second.report.standard_error);
    const double difference = compare(first.image, second.image).rmse / truth.rms;
    truth.error = std::max(expected, difference) / 2.0;
    truth.agreement = expected > 0.0 ? difference / expected : 0.0;
    return truth;
}

} // namespace slopemix::cli
