#include "density_nodes.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace smx {

using std::numbers::pi;

DensityNodes::DensityNodes() {
    for (std::size_t j = 0; j < count; ++j) {
        const double theta = Brdf::theta_h(j);
        cos[j] = std::cos(theta);
        sin[j] = std::sin(theta);
        weight[j] = Brdf::theta_h_weight(j);
        slope[j] = sin[j] / cos[j];
    }
    slope[0] = Brdf::theta_h(1) * std::sqrt(10.0 / 36.0);
}

std::vector<double> DensityNodes::normalise(std::vector<double> &ndf) const {
    std::vector<double> mass(count);
    for (std::size_t j = 0; j < count; ++j) mass[j] = 2 * pi * weight[j] * cos[j] * ndf[j];
    const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
    if (!(total > 0.0) || !std::isfinite(total)) return {};
    for (double &d : ndf) d /= total;
    for (double &m : mass) m /= total;
    return mass;
}

void DensityNodes::store(const std::vector<double> &ndf, SlopeDensity &density) const {
    for (std::size_t j = 0; j < count; ++j) {
        density.slope.push_back(slope[j]);
        density.p22.push_back(ndf[j] * std::pow(cos[j], 4));
        density.area.push_back(2 * pi * weight[j] / std::pow(cos[j], 3));
    }
}

} // namespace smx
