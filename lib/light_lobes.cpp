#include "light_lobes.h"

#include <cmath>
#include <numbers>

namespace smx {

template <typename Real>
std::vector<DeviceLightLobe<Real>> light_lobes(const Material &material, const Displacement &x) {
    const PrincipalAxes axes = principal_axes(x);
    double total = 0.0, up_to = 0.0;
    for (const Lobe &lobe : material.lobes) total += lobe.weight;
    std::vector<DeviceLightLobe<Real>> lobes;
    const auto r = [](double v) { return static_cast<Real>(v); };
    for (const auto &[weight, alpha] : material.lobes) {
        const double share = 0.5 * weight / total + 0.5 / static_cast<double>(material.lobes.size());
        const double alpha_1 = std::sqrt(alpha * alpha + axes.var_1), alpha_2 = std::sqrt(alpha * alpha + axes.var_2);
        up_to += share;
        lobes.push_back({r(up_to), r(alpha_1), r(alpha_2), r(-1.0 / (alpha_1 * alpha_1)), r(-1.0 / (alpha_2 * alpha_2)),
                         r(share / (std::numbers::pi * alpha_1 * alpha_2))});
    }
    return lobes;
}

template std::vector<DeviceLightLobe<float>> light_lobes(const Material &, const Displacement &);
template std::vector<DeviceLightLobe<double>> light_lobes(const Material &, const Displacement &);

} // namespace smx
