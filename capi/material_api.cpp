// smx_material_*, but for its evaluation (render_api.cpp)
#include <algorithm>

#include "fit_material.h"
#include "handles.h"
#include "material_file.h"
#include "packed_material.h"

using namespace smx;

namespace {

FitOptions to_cpp(const smx_fit_options &o) {
    return {static_cast<Model>(o.model), o.lobes, o.tolerance, o.max_iterations, o.refine != 0};
}

std::vector<FresnelCurves> curves_from_array(const double *values, std::size_t sets, std::size_t knots) {
    std::vector<FresnelCurves> curves(sets);
    for (FresnelCurves &set : curves)
        for (std::vector<double> &curve : set) {
            curve.assign(values, values + knots);
            values += knots;
        }
    return curves;
}

Material material_from_arrays(const smx_material_desc &d) {
    require_pointer(d.name, "desc->name");
    require_pointer(d.lobes, "desc->lobes");
    require_pointer(d.fresnel, "desc->fresnel");
    require(d.model == SMX_MODEL_SHARED || d.model == SMX_MODEL_PER_LOBE, "desc->model is ", static_cast<int>(d.model),
            "; it must be 0 (shared) or 1 (per-lobe)");
    require(d.lobe_count >= 1 && d.lobe_count <= max_lobes, "desc->lobe_count is ", d.lobe_count, "; it must be 1..",
            max_lobes);
    require(d.knots >= 2 && d.knots <= 4096, "desc->knots is ", d.knots, "; it must be 2..4096");
    Material m;
    m.name = d.name;
    m.source = "memory";
    m.model = static_cast<Model>(d.model);
    m.theta_d = d.theta_d ? std::vector<double>(d.theta_d, d.theta_d + d.knots) : uniform_knots(d.knots);
    m.fresnel = curves_from_array(d.fresnel, m.model == Model::Shared ? 1 : d.lobe_count, d.knots);
    for (size_t k = 0; k < d.lobe_count; ++k) m.lobes.push_back({d.lobes[k].weight, d.lobes[k].alpha});
    if (m.model == Model::PerLobe) {
        const std::vector<double> shares = energy_shares(m.theta_d, m.fresnel);
        for (size_t k = 0; k < d.lobe_count; ++k) m.lobes[k].weight = shares[k];
    }
    validate(m);
    canonicalise(m);
    return m;
}

smx_material new_handle(Material material) {
    return new smx_material_s(std::make_shared<const Material>(std::move(material)));
}

} // namespace

extern "C" {

smx_status smx_material_fit(smx_density density, const smx_fit_options *options, smx_material *material) {
    return guarded([&] {
        require_pointer(density, "density");
        require_pointer(material, "material");
        const FitOptions o = to_cpp(checked(options, SMX_FIT_OPTIONS_INIT, "options"));
        const auto &[brdf, slopes] = *density->object;
        *material = new_handle(brdf ? fit_material(*brdf, slopes, o) : fit_material(slopes, o));
    });
}

smx_status smx_material_create(const smx_material_desc *desc, smx_material *material) {
    return guarded([&] {
        require_pointer(desc, "desc");
        require_pointer(material, "material");
        *material = new_handle(material_from_arrays(checked(desc, SMX_MATERIAL_DESC_INIT, "desc")));
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
        info->model = static_cast<smx_model>(m.model);
        info->lobes = static_cast<uint32_t>(m.lobes.size());
        info->fresnel_knots = static_cast<uint32_t>(m.theta_d.size());
        info->fresnel_sets = static_cast<uint32_t>(m.fresnel.size());
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
        copy_text(report->refine_message, r.refine_message);
        report->curve_iterations = r.curve_iterations;
        report->brdf_residual_start = r.brdf_residual_start;
        report->brdf_residual = r.brdf_residual;
        report->displaced_share = r.displaced_share;
        copy_text(report->curve_message, r.curve_message);
        report->base_relrmse = r.base_relrmse;
        report->displaced_relrmse = r.displaced_relrmse;
        report->displaced_relrmse_shared = r.displaced_relrmse_shared;
        copy_text(report->choice, r.choice);
        report->seconds = r.seconds;
        report->check_seconds = r.check_seconds;
    });
}

smx_status smx_material_get_deviations(smx_material material, double *alpha, double *curves, size_t count) {
    return guarded([&] {
        require_pointer(material, "material");
        const Material &m = *material->object;
        const Deviations &deviations = m.report.deviations;
        require(count == m.lobes.size(), "count is ", count, "; the material has ", m.lobes.size(), " lobes");
        if (deviations.alpha.empty()) fail(Fault::NoSolution, m.name, " is not a refined per-lobe fit: no deviations");
        if (alpha) std::copy(deviations.alpha.begin(), deviations.alpha.end(), alpha);
        for (const auto &lobe : deviations.curves)
            for (const std::vector<double> &channel : lobe)
                if (curves) curves = std::copy(channel.begin(), channel.end(), curves);
    });
}

smx_status smx_material_get_albedo(smx_material material, double *theta_o, double *table, double *fit) {
    return guarded([&] {
        require_pointer(material, "material");
        const AlbedoReport &albedo = material->object->report.albedo;
        if (albedo.theta_o.empty())
            fail(Fault::NoSolution, material->object->name, " was not fitted to a BRDF: no albedo");
        if (theta_o) std::copy(albedo.theta_o.begin(), albedo.theta_o.end(), theta_o);
        for (const Rgb &value : albedo.table)
            if (table) table = std::copy(value.begin(), value.end(), table);
        for (const Rgb &value : albedo.fit)
            if (fit) fit = std::copy(value.begin(), value.end(), fit);
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

smx_status smx_material_get_fresnel(smx_material material, double *theta_d, double *fresnel, size_t count) {
    return guarded([&] {
        require_pointer(material, "material");
        const Material &m = *material->object;
        const std::size_t own = 3 * m.fresnel.size() * m.theta_d.size();
        require(count == own, "count is ", count, "; it must be ", own, ": 3 channels by ", m.theta_d.size(),
                " knots by ", m.fresnel.size(), " sets of curves");
        if (theta_d) std::copy(m.theta_d.begin(), m.theta_d.end(), theta_d);
        for (const FresnelCurves &curves : m.fresnel)
            for (const std::vector<double> &curve : curves)
                if (fresnel) fresnel = std::copy(curve.begin(), curve.end(), fresnel);
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

smx_status smx_material_pack(smx_material material, float *words, size_t *count) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(count, "count");
        const std::size_t size = packed_size(*material->object);
        if (words) {
            require(*count == size, "*count is ", *count, "; the packed material has ", size, " floats");
            const std::vector<float> packed_words = packed(*material->object);
            std::copy(packed_words.begin(), packed_words.end(), words);
        }
        *count = size;
    });
}

const char *smx_device_header(void) {
    try {
        static const std::string header = kernel_source("slopemix.clh");
        return header.c_str();
    } catch (...) {
        translate_exception();
        return nullptr;
    }
}
}
