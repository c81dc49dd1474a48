// smx_material_*, but for its evaluation (render_api.cpp)
#include <algorithm>

#include "fit_material.h"
#include "handles.h"
#include "material_file.h"

using namespace smx;

namespace {

FitOptions to_cpp(const smx_fit_options &o) { return {o.lobes, o.tolerance, o.max_iterations, o.refine != 0}; }

std::shared_ptr<const Material> material_from_arrays(const char *name, const smx_lobe *lobes, size_t count,
                                                     const double *fresnel, size_t knots) {
    require(count >= 1 && count <= max_lobes, "count is ", count, "; it must be 1..", max_lobes);
    require(knots >= 2 && knots <= 4096, "knots is ", knots, "; it must be 2..4096");
    Material m;
    m.name = name;
    m.source = "memory";
    for (size_t k = 0; k < count; ++k) m.lobes.push_back({lobes[k].weight, lobes[k].alpha});
    m.theta_d = uniform_knots(knots);
    m.fresnel.resize(1);
    for (size_t c = 0; c < 3; ++c) m.fresnel[0][c].assign(fresnel + c * knots, fresnel + (c + 1) * knots);
    validate(m);
    canonicalise(m.lobes);
    return std::make_shared<const Material>(std::move(m));
}

smx_material new_handle(Material material) {
    return new smx_material_s(std::make_shared<const Material>(std::move(material)));
}

}  // namespace

extern "C" {

smx_status smx_material_fit(smx_density density, const smx_fit_options *options, smx_material *material) {
    return guarded([&] {
        require_pointer(density, "density");
        require_pointer(material, "material");
        const FitOptions o = to_cpp(checked(options, SMX_FIT_OPTIONS_INIT, "options"));
        *material = new_handle(fit_material(*density->object->brdf, density->object->density, o));
    });
}

smx_status smx_material_create(const char *name, const smx_lobe *lobes, size_t count, const double *fresnel,
                               size_t knots, smx_material *material) {
    return guarded([&] {
        require_pointer(name, "name");
        require_pointer(lobes, "lobes");
        require_pointer(fresnel, "fresnel");
        require_pointer(material, "material");
        *material = new smx_material_s(material_from_arrays(name, lobes, count, fresnel, knots));
    });
}

smx_status smx_material_retain(smx_material material) { return retain(material, "material"); }
void smx_material_release(smx_material material) { release(material); }

smx_status smx_material_get_info(smx_material material, smx_material_info *info) {
    return guarded([&] {
        require_pointer(material, "material");
        check_output(info, "info");
        const Material &m = *material->object;
        copy_text(info->name, m.name);
        copy_text(info->source, m.source);
        copy_text(info->sha256, m.sha256);
        copy_text(info->model, model_name(m.model));
        info->lobes = static_cast<uint32_t>(m.lobes.size());
        info->fresnel_knots = static_cast<uint32_t>(m.theta_d.size());
    });
}

smx_status smx_material_get_report(smx_material material, smx_fit_report *report) {
    return guarded([&] {
        require_pointer(material, "material");
        check_output(report, "report");
        const FitReport &r = material->object->report;
        report->lobes = static_cast<uint32_t>(material->object->lobes.size());
        report->inversion_iterations = r.inversion_iterations;
        report->em_iterations = r.em_iterations;
        report->refine_iterations = r.refine_iterations;
        report->log_likelihood_em = r.log_likelihood_em;
        report->log_likelihood = r.log_likelihood;
        report->residual_em = r.residual_em;
        report->residual = r.residual;
        report->seconds = r.seconds;
        copy_text(report->refine_message, r.refine_message);
    });
}

smx_status smx_material_get_lobes(smx_material material, smx_lobe *lobes, size_t count) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(lobes, "lobes");
        const std::vector<Lobe> &own = material->object->lobes;
        require(count == own.size(), "count is ", count, "; the material has ", own.size(), " lobes");
        for (size_t k = 0; k < count; ++k) lobes[k] = {own[k].weight, own[k].alpha};
    });
}

smx_status smx_material_get_fresnel(smx_material material, double *fresnel, size_t count) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(fresnel, "fresnel");
        const Material &m = *material->object;
        const std::size_t own = 3 * m.fresnel.size() * m.theta_d.size();
        require(count == own, "count is ", count, "; it must be ", own, ": 3 channels by ", m.theta_d.size(),
                " knots by ", m.fresnel.size(), " sets of curves");
        for (const FresnelCurves &curves : m.fresnel)
            for (const std::vector<double> &curve : curves) fresnel = std::copy(curve.begin(), curve.end(), fresnel);
    });
}

smx_status smx_material_load(const char *path, smx_material *material) {
    return guarded([&] {
        require_pointer(path, "path");
        require_pointer(material, "material");
        *material = new_handle(load_material(path));
    });
}

smx_status smx_material_save(smx_material material, const char *path) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(path, "path");
        save_material(*material->object, path);
    });
}
}
