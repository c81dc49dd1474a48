#include "tabulate.h"

#include <cmath>
#include <vector>

#include "fresnel_fit.h"
#include "material_value.h"
#include "microfacet.h"
#include "table_sampling.h"

namespace smx {

namespace {

// The density's nodes are the table's.
std::vector<double> ndf_of(const SlopeDensity &density) {
    std::vector<double> ndf;
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        ndf.push_back(density.p22[h] / std::pow(std::cos(Brdf::theta_h(h)), 4));
    return ndf;
}

std::vector<Rgb> fresnel_of(const SlopeDensity &density) {
    const std::vector<double> knots = uniform_knots(density.fresnel[0].size());
    std::vector<Rgb> fresnel;
    for (std::size_t d = 0; d < Brdf::theta_d_count; ++d)
        fresnel.push_back(fresnel_at(knots, density.fresnel, Brdf::theta_d(d)));
    return fresnel;
}

} // namespace

Brdf tabulate(const Material &material) {
    return sample_table(material.name, "memory", TableFormula(MaterialValue(material)));
}

Brdf tabulate(const SlopeDensity &density) {
    const std::vector<double> ndf = ndf_of(density);
    const std::vector<Rgb> fresnel = fresnel_of(density);
    const ProjectedArea sigma = projected_area(ndf);
    const auto value = [&](std::size_t h, std::size_t d, const Cosines &at) {
        const double lobe = smith_lobe(at, ndf[h], sigma(at.i), sigma(at.o));
        return Rgb{fresnel[d][0] * lobe, fresnel[d][1] * lobe, fresnel[d][2] * lobe};
    };
    return sample_table(density.name, "memory", TableFormula(value));
}

} // namespace smx
