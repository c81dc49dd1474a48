// smx_brdf_*, smx_density_*, but for figures about tables (errors_api.cpp)
#include <algorithm>
#include <vector>

#include "analytic.h"
#include "builtin.h"
#include "density_csv.h"
#include "handles.h"
#include "merl_file.h"
#include "outliers.h"
#include "sha256.h"

using namespace smx;

namespace {

std::shared_ptr<const Brdf> open_brdf(const std::string &source) {
    if (source.starts_with(builtin_prefix))
        return std::make_shared<const Brdf>(make_builtin(source.substr(builtin_prefix.size())));
    if (source.starts_with(analytic_prefix))
        return std::make_shared<const Brdf>(make_analytic(source.substr(analytic_prefix.size())));
    return std::make_shared<const Brdf>(read_merl(source));
}

std::shared_ptr<const Brdf> brdf_from_values(const char *name, uint32_t phi_d, const double *values) {
    require(phi_d == 180 || phi_d == 360, "phi_d is ", phi_d, "; it must be 180 or 360");
    const std::size_t count = 3 * Brdf::theta_h_count * Brdf::theta_d_count * phi_d;
    std::vector<double> copy(values, values + count);
    const std::string hash = sha256_hex(merl_bytes(phi_d, copy));
    return std::make_shared<const Brdf>(name, "memory", hash, phi_d, std::move(copy));
}

InversionOptions to_cpp(const smx_inversion_options &o) {
    return {static_cast<MaskingKernel>(o.masking_kernel), o.tolerance, o.max_iterations};
}

smx_density new_density(SlopeDensity density) {
    return new smx_density_s(std::make_shared<const DensityOfBrdf>(DensityOfBrdf{nullptr, std::move(density)}));
}

void copy_nodes(const std::vector<double> &from, double *to) {
    if (to) std::copy(from.begin(), from.end(), to);
}

} // namespace

extern "C" {

smx_status smx_brdf_open(const char *path_or_builtin, smx_brdf *brdf) {
    return guarded([&] {
        require_pointer(path_or_builtin, "path_or_builtin");
        require_pointer(brdf, "brdf");
        *brdf = new smx_brdf_s(open_brdf(path_or_builtin));
    });
}

smx_status smx_brdf_create(const char *name, uint32_t phi_d, const double *values, smx_brdf *brdf) {
    return guarded([&] {
        require_pointer(name, "name");
        require_pointer(values, "values");
        require_pointer(brdf, "brdf");
        *brdf = new smx_brdf_s(brdf_from_values(name, phi_d, values));
    });
}

smx_status smx_brdf_retain(smx_brdf brdf) { return retain(brdf, "brdf"); }
void smx_brdf_release(smx_brdf brdf) { release(brdf); }

smx_status smx_brdf_get_info(smx_brdf brdf, smx_brdf_info *info) {
    return guarded([&] {
        require_pointer(brdf, "brdf");
        check_output(info, "info");
        const Brdf &b = *brdf->object;
        copy_text(info->name, b.name());
        copy_text(info->source, b.source());
        copy_text(info->sha256, b.sha256());
        info->theta_h = Brdf::theta_h_count;
        info->theta_d = Brdf::theta_d_count;
        info->phi_d = static_cast<uint32_t>(b.phi_d_count());
        info->cells = b.cells();
        info->invalid_cells = b.invalid_cells();
        info->filled_cells = b.filled_cells();
    });
}

smx_status smx_brdf_get_values(smx_brdf brdf, double *values, size_t count) {
    return guarded([&] {
        require_pointer(brdf, "brdf");
        require_pointer(values, "values");
        const std::vector<double> &table = brdf->object->values();
        require(count == table.size(), "count is ", count, "; the table has ", table.size(), " values");
        std::copy(table.begin(), table.end(), values);
    });
}

smx_status smx_brdf_write(smx_brdf brdf, const char *path) {
    return guarded([&] {
        require_pointer(brdf, "brdf");
        require_pointer(path, "path");
        write_merl(*brdf->object, path);
    });
}

smx_status smx_density_create(smx_brdf brdf, const smx_inversion_options *options, smx_density *density) {
    return guarded([&] {
        require_pointer(brdf, "brdf");
        require_pointer(density, "density");
        const InversionOptions o = to_cpp(checked(options, SMX_INVERSION_OPTIONS_INIT, "options"));
        std::shared_ptr<const Brdf> table = brdf->object;
        if (std::optional<Brdf> clean = without_outliers(*table))
            table = std::make_shared<const Brdf>(std::move(*clean));
        SlopeDensity slopes = invert(*table, o);
        *density = new smx_density_s(std::make_shared<const DensityOfBrdf>(DensityOfBrdf{table, std::move(slopes)}));
    });
}

smx_status smx_density_from_samples(const char *name, smx_density_kind kind, size_t count, const double *theta,
                                    const double *values, smx_density *density) {
    return guarded([&] {
        require_pointer(name, "name");
        require_pointer(theta, "theta");
        require_pointer(values, "values");
        require_pointer(density, "density");
        require(count >= 2 && count <= SMX_MAX_DENSITY_SAMPLES, "count is ", count, "; it must be 2..",
                SMX_MAX_DENSITY_SAMPLES);
        SlopeDensity made =
            density_from_samples({static_cast<DensityKind>(kind), {theta, theta + count}, {values, values + count}});
        made.name = name;
        made.source = "memory";
        *density = new_density(std::move(made));
    });
}

smx_status smx_density_read_csv(const char *path, smx_density *density) {
    return guarded([&] {
        require_pointer(path, "path");
        require_pointer(density, "density");
        *density = new_density(read_density_csv(path));
    });
}

smx_status smx_density_retain(smx_density density) { return retain(density, "density"); }
void smx_density_release(smx_density density) { release(density); }

smx_status smx_density_get_info(smx_density density, smx_density_info *info) {
    return guarded([&] {
        require_pointer(density, "density");
        check_output(info, "info");
        const SlopeDensity &d = density->object->density;
        info->nodes = static_cast<uint32_t>(d.slope.size());
        info->fresnel_knots = static_cast<uint32_t>(d.fresnel[0].size());
        info->iterations = d.iterations;
        info->converged = d.converged;
        info->change = d.change;
        info->alpha = d.alpha();
        copy_text(info->sha256, d.sha256);
    });
}

smx_status smx_density_get_nodes(smx_density density, double *slope, double *p22, double *mass, size_t nodes) {
    return guarded([&] {
        require_pointer(density, "density");
        const SlopeDensity &d = density->object->density;
        require(nodes == d.slope.size(), "nodes is ", nodes, "; the density has ", d.slope.size());
        copy_nodes(d.slope, slope);
        copy_nodes(d.p22, p22);
        copy_nodes(d.mass, mass);
    });
}
}
