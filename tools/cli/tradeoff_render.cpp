#include "tradeoff_render.h"

#include <chrono>

#include "geometric_flags.h"
#include "input.h"
#include "text.h"

namespace slopemix::cli {

namespace {

smx_sampler sampler_of(Method method) {
    if (method == Method::grid) return SMX_SAMPLER_GRID;
    return method == Method::sobol ? SMX_SAMPLER_SOBOL : SMX_SAMPLER_MIS;
}

} // namespace

TradeoffRenderer::TradeoffRenderer(const TradeoffJob &job, Progress &progress)
    : job_(job),
      progress_(progress),
      context_(open_context(job.flags)),
      brdf_(open_brdf(job.input)),
      scene_(scene(job.flags, {job.alpha.first, job.alpha.second, 0.0, 0.0, 0.0}, job.light_degrees)) {}

smx_render_options TradeoffRenderer::options() {
    smx_render_options options = render_options(job_.flags);
    progress_.attach(options);
    return options;
}

Rendering TradeoffRenderer::render(const Configuration &configuration, std::uint32_t run) {
    smx_scene scene = scene_;
    smx_render_options options = this->options();
    options.seed += run;
    options.widening_order = configuration.order;
    variants()[configuration.variant].apply(configuration.method, scene, options);
    if (is_filtered(configuration.method))
        return render_filtered(context_, fit(configuration).material, scene, options);
    options.spp = configuration.samples;
    if (configuration.method == Method::geometric)
        return render_geometric(context_, brdf_, scene, options, GeometricFlags{}.options());
    options.sampler = sampler_of(configuration.method);
    return render_reference(context_, brdf_, scene, options);
}

GroundTruth TradeoffRenderer::truth_of(const Brdf &table, std::uint32_t samples, const std::string &what) {
    smx_render_options options = this->options();
    options.sampler = SMX_SAMPLER_MIS;
    options.spp = samples;
    return ground_truth(context_, table, scene_, options,
                        what + " under a light at " + general(job_.light_degrees) + " degrees");
}

GroundTruth TradeoffRenderer::truth(std::uint32_t samples) { return truth_of(brdf_, samples, name_of(job_.input)); }

GroundTruth TradeoffRenderer::base_truth(const Configuration &filter, std::uint32_t samples) {
    const Brdf table = acquire<Brdf>(smx_material_tabulate, fit(filter).material.get());
    return truth_of(table, samples, "the base fitted to " + name_of(job_.input));
}

const TradeoffRenderer::Fit &TradeoffRenderer::fit(const Configuration &filter) {
    const auto found = fits_.find({filter.method, filter.lobes});
    if (found != fits_.end()) return found->second;
    if (!density_) density_ = invert(brdf_);
    FitFlags flags;
    flags.model = model_of(filter.method);
    flags.lobes = filter.lobes;
    const auto begin = std::chrono::steady_clock::now();
    Material material = cli::fit(density_, flags);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return fits_[{filter.method, filter.lobes}] = {std::move(material), seconds};
}

std::uint64_t TradeoffRenderer::bytes(const Configuration &configuration) {
    if (!is_filtered(configuration.method)) return 4 * 3 * info_of(brdf_).cells;
    const smx_material_info info = info_of(fit(configuration).material);
    const std::uint64_t lobes = 2 * info.lobes, curves = info.fresnel_knots * (1 + 3 * info.fresnel_sets);
    return 4 * (lobes + curves);
}

} // namespace slopemix::cli
