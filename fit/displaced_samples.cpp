#include "displaced_samples.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "microfacet.h"

namespace smx {

using std::numbers::pi;

namespace {

// How finely a displaced surface is integrated and sampled: X's lobe is about alpha wide in angle.
struct Resolution {
    std::size_t facet_azimuths;       // about wh, per theta_h node; divides 360
    std::size_t tilts, tilt_azimuths; // of the macro surface's normal about wh
};

Resolution resolution_for(double alpha) { return alpha >= 0.25 ? Resolution{36, 16, 6} : Resolution{180, 40, 6}; }

// Facets about wh = z under light and view at theta_d from it in the plane y = 0.
struct Facets {
    Eigen::Matrix<double, Eigen::Dynamic, 3> normal;
    Eigen::Matrix<double, Eigen::Dynamic, 3> reflected; // f <i,m>+ <o,m>+ dm, by channel
};

Eigen::Vector3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Facets facets_at(const Brdf &brdf, std::size_t d, std::size_t facet_azimuths) {
    const std::size_t step = 360 / facet_azimuths;
    const auto count = static_cast<Eigen::Index>(Brdf::theta_h_count * facet_azimuths);
    const Eigen::Vector3d wi = direction(Brdf::theta_d(d), 0.0), wo = direction(-Brdf::theta_d(d), 0.0);
    Facets facets;
    facets.normal.resize(count, 3);
    facets.reflected.resize(count, 3);
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t a = 0; a < facet_azimuths; ++a) {
            const std::size_t degrees = a * step + h % step; // shifted from ring to ring
            const auto row = static_cast<Eigen::Index>(h * facet_azimuths + a);
            const Eigen::Vector3d wm = direction(Brdf::theta_h(h), static_cast<double>(degrees) * pi / 180);
            const double area = Brdf::theta_h_weight(h) * 2 * pi / static_cast<double>(facet_azimuths);
            const double cosines = std::max(wi.dot(wm), 0.0) * std::max(wo.dot(wm), 0.0);
            // Seen from the facet, wh is at the azimuth opposite to its own about wh: phi_d is pi minus that.
            const std::size_t cell = brdf.cell(h, d, (540 - degrees) % brdf.phi_d_count());
            facets.normal.row(row) = wm;
            for (std::size_t c = 0; c < 3; ++c)
                facets.reflected(row, static_cast<Eigen::Index>(c)) = brdf.value(c, cell) * cosines * area;
        }
    return facets;
}

// Sum of what the facets reflect by D_X about the macro normal n.
Eigen::Vector3d reflected_by(const Facets &facets, const Eigen::Vector3d &n, double alpha2) {
    const Eigen::ArrayXd cosine = facets.normal * n;
    const Eigen::ArrayXd inv_cos2 = cosine.square().inverse();
    const Eigen::ArrayXd ndf = (-(inv_cos2 - 1.0) / alpha2).exp() * inv_cos2.square() / (pi * alpha2);
    return facets.reflected.transpose() * (cosine > 0.0).select(ndf, 0.0).matrix();
}

DirectionLevel displaced_level(const Brdf &brdf, std::size_t d, double alpha) {
    const auto [facet_azimuths, tilts, tilt_azimuths] = resolution_for(alpha);
    const Facets facets = facets_at(brdf, d, facet_azimuths);
    DirectionLevel level{Brdf::theta_d(d), 0.0, {}};
    for (std::size_t t = 0; t < tilts; ++t)
        for (std::size_t a = 0; a < tilt_azimuths; ++a) {
            const double theta_h = (static_cast<double>(t) + 0.5) / static_cast<double>(tilts) * pi / 2;
            const double phi = (static_cast<double>(a) + 0.5) / static_cast<double>(tilt_azimuths) * pi;
            DirectionSample s = direction_at(theta_h, level.theta_d, pi - phi);
            if (s.ci < min_cosine || s.co < min_cosine) continue;
            const double sigma_i = beckmann_sigma(s.ci, alpha), sigma_o = beckmann_sigma(s.co, alpha);
            const Eigen::Vector3d f = reflected_by(facets, direction(theta_h, phi), alpha * alpha) /
                                      (sigma_i * s.co + sigma_o * s.ci - s.ci * s.co);
            s.f = {f[0], f[1], f[2]};
            s.displacement2 = alpha * alpha;
            s.weight = s.ci * std::sqrt(s.co * std::sin(theta_h));
            level.samples.push_back(s);
        }
    return level;
}

} // namespace

std::vector<DirectionLevel> displaced_levels(const Brdf &brdf, const std::vector<double> &theta_d, double alpha,
                                             double share) {
    std::vector<DirectionLevel> levels;
    for (std::size_t row : table_rows(theta_d)) {
        DirectionLevel level = displaced_level(brdf, row, alpha);
        if (!level.samples.empty()) levels.push_back(std::move(level));
    }
    weigh_levels(levels, share);
    return levels;
}

} // namespace smx
