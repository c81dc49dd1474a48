#include "fit_check.h"

#include <cmath>
#include <numbers>

#include "displaced_samples.h"
#include "material_value.h"

namespace smx {

std::vector<double> light_angles() {
    constexpr double degree = std::numbers::pi / 180;
    return {0.0, 45 * degree, 57 * degree};
}

std::vector<DirectionLevel> displaced_check(const Brdf &brdf) {
    std::vector<DirectionLevel> levels;
    for (double alpha : {0.1, 0.25, 0.5}) {
        const auto more = displaced_levels(brdf, light_angles(), alpha, 1.0);
        levels.insert(levels.end(), more.begin(), more.end());
    }
    return levels;
}

double mean_relrmse(const std::vector<DirectionLevel> &levels, const Material &material) {
    double sum = 0.0;
    for (const DirectionLevel &level : levels) {
        if (level.samples.empty()) continue;
        const MaterialAtLevel value(material, level.theta_d, level.samples.front().displacement2);
        double error2 = 0.0, value2 = 0.0;
        for (const DirectionSample &s : level.samples) {
            const Rgb model = value(s);
            for (std::size_t c = 0; c < 3; ++c) {
                error2 += std::pow(s.weight * (model[c] - s.f[c]), 2);
                value2 += std::pow(s.weight * s.f[c], 2);
            }
        }
        sum += value2 > 0.0 ? std::sqrt(error2 / value2) : 0.0;
    }
    return levels.empty() ? 0.0 : sum / static_cast<double>(levels.size());
}

} // namespace smx
