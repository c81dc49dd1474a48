// A path of the geometric reference, its ray from the viewer and that to the light, beside a sample of the statistical
// one.
#include "bench_job.h"
#include "input.h"
#include "renderings.h"

namespace slopemix::cli {

namespace {

constexpr std::uint32_t samples = 256; // of 16 realisations
constexpr std::uint32_t bounces = 4;

smx_scene rough_sphere() {
    smx_scene scene = SMX_SCENE_INIT;
    scene.displacement = {0.25, 0.25, 0.0, 0.0, 0.0};
    return scene;
}

} // namespace

void bench_geometric(BenchJob &job) {
    job.progress.start("geometric.path", 1.0);
    const Brdf brdf = acquire<Brdf>(smx_brdf_open, "builtin:two-layer");
    const smx_scene scene = rough_sphere();
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.spp = samples;
    options.sampler = SMX_SAMPLER_GRID;
    const smx_geometric_options geometric = SMX_GEOMETRIC_OPTIONS_INIT;
    job.progress.attach(options);
    render_geometric(job.context, brdf, scene, options, geometric); // compile
    render_reference(job.context, brdf, scene, options);
    smx_geometric_options further = geometric;
    further.bounces = bounces;
    render_geometric(job.context, brdf, scene, options, further);
    Times paths, followed, statistical;
    for (int round = 0; round < job.rounds; ++round) {
        paths.add(render_geometric(job.context, brdf, scene, options, geometric).report);
        followed.add(render_geometric(job.context, brdf, scene, options, further).report);
        statistical.add(render_reference(job.context, brdf, scene, options).report);
    }
    job.rows.push_back({"geometric.path", SMX_GRADE_PRECISE, paths.median(), "statistical", statistical.median()});
    job.rows.push_back(
        {"effects.interreflection", SMX_GRADE_PRECISE, followed.median(), "geometric.path", paths.median()});
    job.progress.finish();
}

} // namespace slopemix::cli
