// smx_render_*, smx_material_eval, smx_brdf_eval
#include "draw_geometry.h"
#include "eval_table.h"
#include "handles.h"
#include "integrate_reference.h"
#include "shade_filtered.h"

using namespace smx;

namespace {

Displacement to_cpp(const smx_displacement &x) { return {x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y}; }

Scene to_cpp(const smx_scene &s) {
    return {s.width, s.height, s.light_phi, to_cpp(s.displacement), static_cast<Masking>(s.masking)};
}

RenderOptions to_cpp(const smx_render_options &o) {
    RenderOptions out{static_cast<Sampler>(o.sampler), o.spp, o.seed, static_cast<Lookup>(o.lookup), o.target_error, {},
                      static_cast<Grade>(o.grade)};
    if (o.progress)
        out.progress = [call = o.progress, user = o.progress_user](double share) { return call(user, share) != 0; };
    return out;
}

// What the three integrators have in common: arguments, and outputs that are written only at the end.
template <typename Integrator>
smx_status render(smx_context context, const void *material, const char *material_name, const smx_scene *scene,
                  const smx_render_options *options, smx_image *image, smx_render_report *report,
                  Integrator integrator) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(material, material_name);
        require_pointer(scene, "scene");
        require_pointer(image, "image");
        if (report) check_output(report, "report");
        const Scene s = to_cpp(checked(scene, smx_scene{}, "scene"));
        const RenderOptions o = to_cpp(checked(options, SMX_RENDER_OPTIONS_INIT, "options"));
        Rendered rendered = integrator(*context->object, s, o);
        const RenderReport r = rendered.report;
        *image = new smx_image_s(std::make_shared<Image>(std::move(rendered.image)));
        if (report) {
            *report = {sizeof *report, r.seconds, r.kernel_seconds, r.build_seconds,
                       r.evaluations,  r.spp,     r.standard_error};
        }
    });
}

} // namespace

extern "C" {

smx_status smx_render_filtered(smx_context context, smx_material material, const smx_scene *scene,
                               const smx_render_options *options, smx_image *image, smx_render_report *report) {
    return render(context, material, "material", scene, options, image, report,
                  [&](Context &c, const Scene &s, const RenderOptions &o) {
                      const auto kept = material->object;
                      return shade_filtered(c, *kept, s, o);
                  });
}

smx_status smx_render_reference(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                const smx_render_options *options, smx_image *image, smx_render_report *report) {
    return render(context, brdf, "brdf", scene, options, image, report,
                  [&](Context &c, const Scene &s, const RenderOptions &o) {
                      const auto kept = brdf->object;
                      const auto proposal = brdf->proposal;
                      return integrate_reference(
                          c, *kept, [&]() -> const std::vector<Lobe> & { return proposal->lobes(); }, s, o);
                  });
}

smx_status smx_render_geometry(smx_context context, const smx_scene *scene, const smx_render_options *options,
                               smx_image *image, smx_render_report *report) {
    return render(context, context, "context", scene, options, image, report,
                  [](Context &c, const Scene &s, const RenderOptions &o) { return draw_geometry(c, s, o); });
}

smx_status smx_material_eval(smx_context context, smx_material material, const smx_displacement *displacement,
                             smx_masking masking, size_t count, const float *wi, const float *wo, float *fcos) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(material, "material");
        require_pointer(displacement, "displacement");
        require_pointer(wi, "wi");
        require_pointer(wo, "wo");
        require_pointer(fcos, "fcos");
        shade_filtered_pairs(*context->object, *material->object, to_cpp(*displacement), static_cast<Masking>(masking),
                             count, wi, wo, fcos);
    });
}

smx_status smx_brdf_eval(smx_context context, smx_brdf brdf, smx_lookup lookup, size_t count, const float *wi,
                         const float *wo, float *f) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(brdf, "brdf");
        require_pointer(wi, "wi");
        require_pointer(wo, "wo");
        require_pointer(f, "f");
        eval_table(*context->object, *brdf->object, static_cast<Lookup>(lookup), count, wi, wo, f);
    });
}
}
