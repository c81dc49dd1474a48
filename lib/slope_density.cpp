#include "slope_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "clamped_cosine.h"
#include "error.h"
#include "fresnel_fit.h"

namespace smx {

using std::numbers::pi;

namespace {

constexpr std::size_t nodes = Brdf::theta_h_count;

// The table's theta_h nodes with the weights of a quadrature over theta.
struct Nodes {
    std::array<double, nodes> cos{}, sin{}, weight{}, slope{};
};

// theta = u^2 pi/2 on equidistant u. The densities vanish smoothly at both ends in u, where the trapezoid rule
// converges fastest. Its weight at node 0 is zero; node 0 gets that of a linear interpolant's first half cell, integral
// of (1 - u/h) theta dtheta, with the root mean square slope there, so that a mirror, whose mass is all in node 0, has
// mass. A Beckmann alpha comes back to 0.44 % at 1e-3, to 0.05 % from 3e-3; below 1e-3 it is not in the table.
Nodes make_nodes() {
    Nodes n;
    constexpr double h = 1.0 / nodes;
    for (std::size_t j = 0; j < nodes; ++j) {
        const double theta = Brdf::theta_h(j), u = static_cast<double>(j) * h;
        n.cos[j] = std::cos(theta);
        n.sin[j] = std::sin(theta);
        n.weight[j] = n.sin[j] * pi * u * h;
        n.slope[j] = n.sin[j] / n.cos[j];
    }
    const double first = Brdf::theta_h(1);
    n.weight[0] = first * first / 10;
    n.slope[0] = first * std::sqrt(10.0 / 36.0);
    return n;
}

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

// Shares of the projected area, mass[j] ~ D cos, from a distribution of normals; normalises the distribution.
std::vector<double> normalise(const Nodes &n, std::vector<double> &ndf) {
    std::vector<double> mass(nodes);
    for (std::size_t j = 0; j < nodes; ++j) mass[j] = 2 * pi * n.weight[j] * n.cos[j] * ndf[j];
    const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
    if (!(total > 0.0) || !std::isfinite(total)) fail(Fault::NoSolution, "the table reflects nothing back at wi = wo");
    for (double &d : ndf) d /= total;
    for (double &m : mass) m /= total;
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
    const Nodes n = make_nodes();
    SlopeDensity density;
    const Matrix kernel = inversion_kernel(n, retro_reflection(brdf), options.masking_kernel);
    const std::vector<double> ndf = dominant_ndf(n, kernel, options, density);
    for (std::size_t j = 0; j < nodes; ++j) {
        density.slope.push_back(n.slope[j]);
        density.p22.push_back(ndf[j] * std::pow(n.cos[j], 4));
        density.area.push_back(2 * pi * n.weight[j] / std::pow(n.cos[j], 3));
    }
    density.fresnel = fit_fresnel(brdf, ndf);
    return density;
}

} // namespace smx
