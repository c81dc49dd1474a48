#include "device_lobe.h"

#include <cmath>
#include <numbers>

namespace smx {

namespace {

// PEAK_SCALE in cl/mixture.clh.
constexpr double peak_scale = 0x1p-16;

template <typename Real>
DeviceLobe<Real> widened_lobe(double weight, double alpha, const PrincipalAxes &x) {
    const double alpha2 = alpha * alpha, var_1 = alpha2 + x.var_1, var_2 = alpha2 + x.var_2;
    const auto r = [](double v) { return static_cast<Real>(v); };
    if (var_1 == 0.0 || var_2 == 0.0) return {r(weight), r(alpha2), 0, 0, 0};
    const double peak = weight / (std::numbers::pi * std::sqrt(var_1) * std::sqrt(var_2)) * peak_scale;
    return {r(weight), r(alpha2), r(-std::numbers::log2e / var_1), r(-std::numbers::log2e / var_2), r(peak)};
}

} // namespace

template <typename Real>
std::vector<DeviceLobe<Real>> widened_lobes(const Material &material, const Displacement &x, LobeWeight which) {
    const PrincipalAxes axes = principal_axes(x);
    const std::vector<double> weights = lobe_weights(material, which);
    std::vector<DeviceLobe<Real>> lobes;
    for (std::size_t k = 0; k < weights.size(); ++k)
        lobes.push_back(widened_lobe<Real>(weights[k], material.lobes[k].alpha, axes));
    return lobes;
}

template std::vector<DeviceLobe<float>> widened_lobes(const Material &, const Displacement &, LobeWeight);
template std::vector<DeviceLobe<double>> widened_lobes(const Material &, const Displacement &, LobeWeight);

} // namespace smx
