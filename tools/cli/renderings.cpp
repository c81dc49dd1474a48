// Calls of the rendering functions, with their two results as one.
#include "renderings.h"

#include <numbers>

namespace slopemix::cli {

namespace {

Rendering rendering(const smx_render_options &options, auto render, auto... arguments) {
    smx_image image = nullptr; // and stays so where a file takes the image
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    check(render(arguments..., &options, options.exr_path ? nullptr : &image, &report));
    return {Image(image), report};
}

} // namespace

smx_render_options render_options(const RenderFlags &flags) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.sampler = flags.sampler;
    options.spp = flags.spp;
    options.target_error = flags.target_error;
    options.scrambles = flags.scrambles;
    options.seed = flags.seed;
    options.lookup = flags.lookup;
    options.grade = flags.grade;
    options.widening_order = flags.widening_order;
    options.widening_tolerance = flags.widening_tolerance;
    options.effects = flags.effects;
    options.effect_tolerance = flags.effect_tolerance;
    return options;
}

smx_scene scene(const RenderFlags &flags, const smx_displacement &displacement, double light_degrees) {
    smx_scene scene = SMX_SCENE_INIT;
    scene.width = flags.resolution.width;
    scene.height = flags.resolution.height;
    scene.light_phi = light_degrees * std::numbers::pi / 180.0;
    scene.displacement = displacement;
    scene.masking = flags.masking;
    return scene;
}

bool takes_double(const Context &context) {
    const smx_lobe lobe = {1.0, 0.1};
    const double fresnel[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}; // two knots
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.lobes = &lobe;
    desc.lobe_count = 1;
    desc.knots = 2;
    desc.fresnel = fresnel;
    const Material material = acquire<Material>(smx_material_create, &desc);
    smx_displacement smooth = {0.0, 0.0, 0.0, 0.0, 0.0};
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.grade = SMX_GRADE_DOUBLE;
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float fcos[3];
    return smx_material_eval(context.get(), material.get(), &smooth, SMX_G2_CORRELATED, &options, 1, up, up, fcos) ==
           SMX_OK;
}

Rendering render_filtered(const Context &context, const Material &material, const smx_scene &scene,
                          const smx_render_options &options) {
    return rendering(options, smx_render_filtered, context.get(), material.get(), &scene);
}

Rendering render_reference(const Context &context, const Brdf &brdf, const smx_scene &scene,
                           const smx_render_options &options) {
    return rendering(options, smx_render_reference, context.get(), brdf.get(), &scene);
}

Rendering render_geometric(const Context &context, const Brdf &brdf, const smx_scene &scene,
                           const smx_render_options &options, const smx_geometric_options &geometric) {
    const auto render = [&](smx_context c, smx_brdf b, const smx_scene *s, const smx_render_options *o,
                            smx_image *image, smx_render_report *report) {
        return smx_render_geometric(c, b, s, o, &geometric, image, report);
    };
    return rendering(options, render, context.get(), brdf.get(), &scene);
}

Rendering render_geometry(const Context &context, const smx_scene &scene, const smx_render_options &options) {
    return rendering(options, smx_render_geometry, context.get(), &scene);
}

double seconds_per_sample(double seconds, double build_seconds, std::uint64_t evaluations) {
    return evaluations == 0 ? 0.0 : (seconds - build_seconds) / static_cast<double>(evaluations);
}

} // namespace slopemix::cli
