#include "density_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "density_nodes.h"
#include "error.h"

namespace smx {

namespace {

constexpr double max_value = 1e30;
constexpr double max_theta = std::numbers::pi / 2 + 1e-6;
constexpr std::size_t fresnel_knots = Brdf::theta_d_count + 1; // as an inversion gives them

void validate(const DensitySamples &s) {
    require(s.kind == DensityKind::P22 || s.kind == DensityKind::Ndf, "kind is ", static_cast<int>(s.kind),
            "; it must be 0 (p22) or 1 (ndf)");
    require(s.theta.size() >= 2, "count is ", s.theta.size(), "; a density needs at least 2 samples");
    for (std::size_t k = 0; k < s.theta.size(); ++k) {
        const auto fault = sample_fault(s.theta[k], s.values[k], k > 0 ? s.theta[k - 1] : -1.0);
        require(!fault, "sample ", k, ": ", fault.value_or(""));
    }
}

double interpolate(const DensitySamples &s, double theta) {
    if (theta > s.theta.back()) return 0.0;
    const auto next = std::upper_bound(s.theta.begin(), s.theta.end(), theta);
    const auto above = static_cast<std::size_t>(next - s.theta.begin());
    if (above == 0) return s.values.front();
    if (above == s.theta.size()) return s.values.back();
    const double share = (theta - s.theta[above - 1]) / (s.theta[above] - s.theta[above - 1]);
    return std::lerp(s.values[above - 1], s.values[above], share);
}

} // namespace

std::optional<std::string> sample_fault(double theta, double value, double before) {
    if (!(theta >= 0.0 && theta <= max_theta)) return text("theta is ", theta, "; it must be 0..pi/2, in radians");
    if (theta <= before) return text("theta is ", theta, ", not above the one before it, ", before);
    if (!(value >= 0.0 && value <= max_value)) return text("the value is ", value, "; it must be 0..", max_value);
    return std::nullopt;
}

SlopeDensity density_from_samples(const DensitySamples &samples) {
    validate(samples);
    const DensityNodes nodes;
    std::vector<double> ndf;
    for (std::size_t j = 0; j < DensityNodes::count; ++j) {
        const double per_slope = samples.kind == DensityKind::P22 ? std::pow(nodes.cos[j], 4) : 1.0;
        ndf.push_back(interpolate(samples, Brdf::theta_h(j)) / per_slope);
    }
    SlopeDensity density;
    density.mass = nodes.normalise(ndf);
    if (density.mass.empty()) fail(Fault::NoSolution, "the density is 0 at every angle of the inversion's nodes");
    nodes.store(ndf, density);
    density.converged = true;
    for (std::vector<double> &curve : density.fresnel) curve.assign(fresnel_knots, 1.0);
    return density;
}

} // namespace smx
