#include "per_lobe_fit.h"

#include <cmath>

#include "lobe_value.h"

namespace smx {

Rgb value_at(const PerLobeFit &fit, const CurveShares &shares, const DirectionSample &sample) {
    Rgb f{};
    for (std::size_t k = 0; k < fit.alphas.size(); ++k) {
        const double lobe = lobe_value(sample, fit.alphas[k]).value;
        if (lobe == 0.0) continue; // far out on a sharp lobe
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t a = 0; a < 3; ++a) f[c] += shares.weight[a] * fit.curves[k][c][shares.first + a] * lobe;
    }
    return f;
}

double brdf_residual(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit) {
    double error2 = 0.0, value2 = 0.0;
    for (const DirectionLevel &level : levels) {
        const CurveShares shares = curve_shares(level.theta_d);
        for (const DirectionSample &s : level.samples) {
            const Rgb model = value_at(fit, shares, s);
            for (std::size_t c = 0; c < 3; ++c) {
                const double error = s.weight * (model[c] - s.f[c]), value = s.weight * s.f[c];
                error2 += error * error;
                value2 += value * value;
            }
        }
    }
    return value2 > 0.0 ? std::sqrt(error2 / value2) : 0.0;
}

} // namespace smx
