#include "projected_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clamped_cosine.h"

namespace smx {

using std::numbers::pi;

namespace {

// The samples sit at cosines x^2 of equidistant x: a sharp distribution bends within its own alpha of the horizon. Off
// by at most 2e-5 of the value for Beckmann's and GGX's alphas 0.1..1, by 2e-4 at 0.01, by 2e-3 at 0.001, by 6e-3
// at 10.
constexpr std::size_t intervals = 512;

constexpr std::size_t polar_nodes = 1024; // of the midpoint rule

} // namespace

ProjectedArea::ProjectedArea(const std::vector<double> &theta, const std::vector<double> &weight) {
    sample(theta, weight);
}

ProjectedArea::ProjectedArea(const std::function<double(double)> &ndf) {
    std::vector<double> theta, weight;
    for (std::size_t j = 0; j < polar_nodes; ++j) {
        const double u = (static_cast<double>(j) + 0.5) / polar_nodes;
        theta.push_back(u * u * pi / 2);
        weight.push_back(ndf(std::cos(theta[j])) * std::sin(theta[j]) * u);
    }
    sample(theta, weight);
}

void ProjectedArea::sample(const std::vector<double> &theta, const std::vector<double> &weight) {
    double norm = 0.0;
    for (std::size_t j = 0; j < theta.size(); ++j) norm += 2 * pi * std::cos(theta[j]) * weight[j];
    for (std::size_t s = 0; s <= intervals; ++s) {
        const double x = static_cast<double>(s) / intervals, cos_k = x * x, sin_k = std::sqrt(1.0 - cos_k * cos_k);
        double area = 0.0;
        for (std::size_t j = 0; j < theta.size(); ++j)
            area += clamped_cosine_ring(cos_k * std::cos(theta[j]), sin_k * std::sin(theta[j])) * weight[j];
        samples_.push_back(norm > 0.0 ? area / norm : cos_k);
    }
}

double ProjectedArea::operator()(double cos_k) const {
    const double at = std::sqrt(std::max(cos_k, 0.0)) * intervals;
    const auto below = std::min(static_cast<std::size_t>(at), intervals - 1);
    return std::lerp(samples_[below], samples_[below + 1], at - static_cast<double>(below));
}

} // namespace smx
