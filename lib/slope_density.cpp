#include "slope_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "clamped_cosine.h"
#include "density_nodes.h"
#include "error.h"
#include "fresnel_fit.h"

namespace smx {

using std::numbers::pi;

namespace {

using Nodes = DensityNodes;
constexpr std::size_t nodes = Nodes::count;

// Retro-reflection f(o, o), mean over the channels and phi_d (at theta_d = 0 the azimuth has no meaning).
std::array<double, nodes> retro_reflection(const Brdf &brdf) {
    std::array<double, nodes> f{};
    for (std::size_t h = 0; h < nodes; ++h) {
        double sum = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) sum += brdf.value(c, brdf.cell(h, 0, p));
        f[h] = sum / (3.0 * static_cast<double>(brdf.phi_d_count()));
    }
    return f;
}

using Matrix = std::vector<std::array<double, nodes>>;

// D(o) = constant times sum over h of kernel(o, h) D(h).
Matrix inversion_kernel(const Nodes &n, const std::array<double, nodes> &retro, MaskingKernel masking) {
    Matrix kernel(nodes);
    for (std::size_t o = 0; o < nodes; ++o)
        for (std::size_t h = 0; h < nodes; ++h) {
            const double cos_cos = n.cos[o] * n.cos[h], sin_sin = n.sin[o] * n.sin[h];
            double ring = clamped_cosine_ring(cos_cos, sin_sin);
            if (masking == MaskingKernel::Correlated) ring = 2 * ring - 2 * pi * cos_cos;
            kernel[o][h] = retro[o] * n.cos[o] * ring * n.weight[h];
        }
    return kernel;
}

// Shares of the projected area; a table without any cannot be inverted.
std::vector<double> normalise(const Nodes &n, std::vector<double> &ndf) {
    std::vector<double> mass = n.normalise(ndf);
    if (mass.empty()) fail(Fault::NoSolution, "the table reflects nothing back at wi = wo");
    return mass;
}

double l1_distance(const std::vector<double> &a, const std::vector<double> &b) {
    double change = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) change += std::abs(a[j] - b[j]);
    return change; // both sum to 1
}

// Power iteration from a uniform distribution, whose first product is the retro-reflection itself.
std::vector<double> dominant_ndf(const Nodes &n, const Matrix &kernel, const InversionOptions &options,
                                 SlopeDensity &result) {
    std::vector<double> ndf(nodes, 1.0), mass = normalise(n, ndf);
    while (!result.converged && result.iterations < options.max_iterations) {
        std::vector<double> next(nodes, 0.0);
        for (std::size_t o = 0; o < nodes; ++o)
            next[o] = std::inner_product(kernel[o].begin(), kernel[o].end(), ndf.begin(), 0.0);
        const std::vector<double> next_mass = normalise(n, next);
        result.change = l1_distance(mass, next_mass);
        result.converged = result.change < options.tolerance;
        ++result.iterations;
        ndf = std::move(next);
        mass = next_mass;
    }
    result.mass = mass;
    return ndf;
}

} // namespace

void validate(const InversionOptions &o) {
    require(o.masking_kernel == MaskingKernel::Coincides || o.masking_kernel == MaskingKernel::Correlated,
            "masking_kernel is ", static_cast<int>(o.masking_kernel), "; it must be 0 or 1");
    require(o.tolerance > 0.0 && std::isfinite(o.tolerance), "tolerance is ", o.tolerance, "; it must be above 0");
    require(o.max_iterations >= 1 && o.max_iterations <= 100000, "max_iterations is ", o.max_iterations,
            "; it must be 1..100000");
}

double SlopeDensity::alpha() const {
    double mean2 = 0.0;
    for (std::size_t j = 0; j < slope.size(); ++j) mean2 += mass[j] * slope[j] * slope[j];
    return std::sqrt(mean2);
}

SlopeDensity invert(const Brdf &brdf, const InversionOptions &options) {
    validate(options);
    const Nodes n;
    SlopeDensity density;
    const Matrix kernel = inversion_kernel(n, retro_reflection(brdf), options.masking_kernel);
    const std::vector<double> ndf = dominant_ndf(n, kernel, options, density);
    n.store(ndf, density);
    density.fresnel = fit_fresnel(brdf, ndf);
    density.name = brdf.name();
    density.source = brdf.source();
    density.sha256 = brdf.sha256();
    return density;
}

} // namespace smx
