#include "rough_surface.h"

namespace smx {

double lost_energy(const RoughSurface &x, const Direction3 &wo) {
    constexpr int facets = 64;
    double lost = 0.0, all = 0.0;
    for (int n = 0; n < facets; ++n) {
        const auto [slope_x, slope_y] = x.slope(0.0, even_point(n));
        // The facet's share, <wo, m> / m_z with m along (-slope_x, -slope_y, 1), and wo reflected by it.
        const double seen = wo[2] - wo[0] * slope_x - wo[1] * slope_y;
        if (seen <= 0.0) continue;
        const double turned = 2.0 * seen / (1.0 + slope_x * slope_x + slope_y * slope_y);
        const Direction3 wi = {-slope_x * turned - wo[0], -slope_y * turned - wo[1], turned - wo[2]};
        const double p_i = x.mean_plane(wi);
        const double leaves = p_i > 0.0 ? p_i / (p_i + sigma_beyond_p(p_i, x.s2(0.0, wi))) : 0.0;
        lost += seen * (1.0 - leaves);
        all += seen;
    }
    return all > 0.0 ? lost / all : 0.0;
}

} // namespace smx
