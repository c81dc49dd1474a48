#include "proposal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "density_nodes.h"
#include "em.h"

namespace smx {

namespace {

using std::numbers::pi;

// A proposal needs the shape and no more: every lobe costs time at every facet drawn, every step of EM at every image.
constexpr unsigned lobe_count = 8, em_steps = 100;
constexpr double em_tolerance = 1e-5;

double luminance(const Brdf &brdf, std::size_t cell) {
    return (brdf.value(0, cell) + brdf.value(1, cell) + brdf.value(2, cell)) / 3;
}

// Mean over phi_d of f <wi,wm>+ <wo,wm>+, wm at theta_h from wh: what facets of every direction alike would reflect.
double reflected(const Brdf &brdf, std::size_t theta_h, std::size_t theta_d) {
    const double h = Brdf::theta_h(theta_h), d = Brdf::theta_d(theta_d);
    const double along = std::cos(d) * std::cos(h), across = std::sin(d) * std::sin(h);
    double sum = 0.0;
    for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) {
        const double turned = across * std::cos(brdf.phi_d(p)); // even in phi_d, and f has the period pi
        const double i_m = std::max(along + turned, 0.0), o_m = std::max(along - turned, 0.0);
        sum += luminance(brdf, brdf.cell(theta_h, theta_d, p)) * i_m * o_m;
    }
    return sum / static_cast<double>(brdf.phi_d_count());
}

// The facets' share of what is reflected, as a slope density about wh.
SlopeDensity density_about_wh(const Brdf &brdf, std::size_t first, std::size_t count) {
    static const DensityNodes nodes;
    std::vector<double> ndf(DensityNodes::count, 0.0);
    for (std::size_t h = 0; h < DensityNodes::count; ++h) {
        for (std::size_t d = first; d < first + count; ++d) ndf[h] += reflected(brdf, h, d);
        ndf[h] /= nodes.cos[h]; // normalise() takes D, whose mass is D cos
    }
    SlopeDensity density;
    density.mass = nodes.normalise(ndf);
    density.slope.assign(nodes.slope.begin(), nodes.slope.end());
    return density;
}

} // namespace

const std::vector<Lobe> &Proposal::of_rows(std::size_t first, std::size_t count) {
    const std::lock_guard lock(mutex_);
    const std::pair rows(first, count);
    if (const auto found = fitted_.find(rows); found != fitted_.end()) return found->second;
    const SlopeDensity density = density_about_wh(*brdf_, first, count);
    std::vector<Lobe> lobes;
    if (!density.mass.empty()) lobes = fit_em(density, lobe_count, em_tolerance, em_steps).lobes;
    return fitted_.emplace(rows, std::move(lobes)).first->second;
}

const std::vector<Lobe> &Proposal::lobes(double theta_d) {
    const double row = theta_d / (pi / 2) * Brdf::theta_d_count;
    return of_rows(std::min(static_cast<std::size_t>(std::lround(row)), Brdf::theta_d_count - 1), 1);
}

const std::vector<Lobe> &Proposal::lobes() { return of_rows(0, Brdf::theta_d_count); }

} // namespace smx
