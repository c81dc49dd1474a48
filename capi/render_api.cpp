// smx_render_*, smx_material_eval, smx_brdf_eval, smx_brdf_integrate
#include "draw_geometry.h"
#include "eval_table.h"
#include "evaluator.h"
#include "integrate_geometric.h"
#include "render_arguments.h"
#include "shade_filtered.h"

using namespace smx;

namespace {

smx_displacement to_c(const Displacement &x) { return {x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y}; }

} // namespace

namespace smx {

Displacement to_cpp(const smx_displacement &x) { return {x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y}; }

Scene to_cpp(const smx_scene &s) {
    return {s.width,
            s.height,
            s.light_phi,
            to_cpp(s.displacement),
            static_cast<Masking>(s.masking),
            static_cast<Light>(s.light)};
}

GeometricOptions to_cpp(const smx_geometric_options &g) { return {g.tile, g.realisations, g.bounces}; }

RenderOptions to_cpp(const smx_render_options &o) {
    RenderOptions out;
    out.sampler = static_cast<Sampler>(o.sampler);
    out.spp = o.spp;
    out.seed = o.seed;
    out.lookup = static_cast<Lookup>(o.lookup);
    out.target_error = o.target_error;
    out.grade = static_cast<Grade>(o.grade);
    out.widening_order = o.widening_order;
    out.widening_tolerance = o.widening_tolerance;
    out.effects = o.effects;
    out.effect_tolerance = o.effect_tolerance;
    out.scrambles = o.scrambles;
    out.errors = o.errors != 0;
    out.whole_table = o.whole_table != 0;
    if (o.exr_path) out.exr_path = o.exr_path;
    require(!o.exr_path || *o.exr_path, "exr_path is empty; it must be a file's path or null");
    if (o.progress)
        out.progress = [call = o.progress, user = o.progress_user](double share) { return call(user, share) != 0; };
    return out;
}

ProposalSource proposal_of(smx_brdf brdf) {
    return [proposal = brdf->proposal](std::optional<double> theta_d) -> const std::vector<Lobe> & {
        return theta_d ? proposal->lobes(*theta_d) : proposal->lobes();
    };
}

} // namespace smx

namespace {

void fill(smx_render_report *report, const RenderReport &r) {
    if (!report) return;
    *report = {sizeof *report,
               r.seconds,
               r.kernel_seconds,
               r.build_seconds,
               r.evaluations,
               r.spp,
               r.standard_error,
               {},
               r.unsettled,
               r.effects,
               static_cast<uint32_t>(r.lobes),
               r.interreflection};
    for (std::size_t k = 0; k < r.orders.size(); ++k)
        report->widening_orders[k] = static_cast<std::uint8_t>(r.orders[k]);
}

// What the integrators have in common: arguments, and outputs that are written only at the end.
template <typename Handle, typename Integrator>
smx_status render(smx_context context, Handle material, const char *material_name, const smx_scene *scene,
                  const smx_render_options *options, smx_image *image, smx_render_report *report,
                  Integrator integrator) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(material, material_name);
        require_pointer(scene, "scene");
        if (report) check_output(report, "report");
        const Scene s = to_cpp(checked(scene, smx_scene{}, "scene"));
        const RenderOptions o = to_cpp(checked(options, SMX_RENDER_OPTIONS_INIT, "options"));
        if (o.exr_path.empty()) require_pointer(image, "image");
        require(o.exr_path.empty() || !image, "image must be null where exr_path takes the image");
        Rendered rendered = integrator(*context->object, s, o);
        if (rendered.image) *image = new smx_image_s(std::make_shared<Image>(std::move(*rendered.image)));
        fill(report, rendered.report);
    });
}

} // namespace

extern "C" {

smx_status smx_displacement_add(const smx_displacement *x, const smx_displacement *y, smx_displacement *sum) {
    return guarded([&] {
        require_pointer(x, "x");
        require_pointer(y, "y");
        require_pointer(sum, "sum");
        *sum = to_c(to_cpp(*x) + to_cpp(*y));
    });
}

smx_status smx_render_filtered(smx_context context, smx_material material, const smx_scene *scene,
                               const smx_render_options *options, smx_image *image, smx_render_report *report) {
    return render(context, material, "material", scene, options, image, report,
                  [&](Context &c, const Scene &s, const RenderOptions &o) {
                      const auto kept = material->object;
                      const auto choices = material->effects;
                      const auto [simulated, seconds] = choices->simulated(s, o);
                      Rendered rendered = shade_filtered(c, *kept, s, o, simulated);
                      rendered.report.seconds += seconds;
                      return rendered;
                  });
}

smx_status smx_render_reference(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                const smx_render_options *options, smx_image *image, smx_render_report *report) {
    return render(context, brdf, "brdf", scene, options, image, report,
                  [&](Context &c, const Scene &s, const RenderOptions &o) {
                      const auto kept = brdf->object;
                      return integrate_reference(c, *kept, proposal_of(brdf), s, o);
                  });
}

smx_status smx_render_geometric(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                const smx_render_options *options, const smx_geometric_options *geometric,
                                smx_image *image, smx_render_report *report) {
    return render(context, brdf, "brdf", scene, options, image, report,
                  [&](Context &c, const Scene &s, const RenderOptions &o) {
                      const auto kept = brdf->object;
                      const GeometricOptions g = to_cpp(checked(geometric, SMX_GEOMETRIC_OPTIONS_INIT, "geometric"));
                      return integrate_geometric(c, *kept, proposal_of(brdf), s, o, g);
                  });
}

smx_status smx_render_geometry(smx_context context, const smx_scene *scene, const smx_render_options *options,
                               smx_image *image, smx_render_report *report) {
    return render(context, context, "context", scene, options, image, report,
                  [](Context &c, const Scene &s, const RenderOptions &o) { return draw_geometry(c, s, o); });
}

smx_status smx_material_eval(smx_context context, smx_material material, const smx_displacement *displacement,
                             smx_masking masking, const smx_render_options *options, size_t count, const float *wi,
                             const float *wo, float *fcos) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(material, "material");
        require_pointer(displacement, "displacement");
        require_pointer(wi, "wi");
        require_pointer(wo, "wo");
        require_pointer(fcos, "fcos");
        Evaluator evaluator(*context->object, *material->object, to_cpp(*displacement), static_cast<Masking>(masking),
                            to_cpp(checked(options, SMX_RENDER_OPTIONS_INIT, "options")));
        evaluator.evaluate(Quantity::Fcos, count,
                           {written_vectors(fcos, fcos + 1, fcos + 2, 3), read_vectors(wi, wi + 1, wi + 2, 3),
                            read_vectors(wo, wo + 1, wo + 2, 3)});
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

smx_status smx_brdf_integrate(smx_context context, smx_brdf brdf, const smx_displacement *displacement,
                              smx_masking masking, const smx_render_options *options, size_t count, const float *wi,
                              const float *wo, float *fcos, float *errors, smx_render_report *report) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(brdf, "brdf");
        require_pointer(displacement, "displacement");
        require_pointer(wi, "wi");
        require_pointer(wo, "wo");
        require_pointer(fcos, "fcos");
        if (report) check_output(report, "report");
        RenderOptions o = to_cpp(checked(options, SMX_RENDER_OPTIONS_INIT, "options"));
        o.errors = errors != nullptr;
        const auto kept = brdf->object;
        fill(report, integrate_pairs(*context->object, *kept, proposal_of(brdf), to_cpp(*displacement),
                                     static_cast<Masking>(masking), o, count, wi, wo, fcos, errors));
    });
}
}
