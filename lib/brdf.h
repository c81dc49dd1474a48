// An isotropic measured BRDF on the MERL grid: Matusik, Pfister, Brand, McMillan, "A Data-Driven Reflectance Model"
// (2003). Value k of an axis sits at theta_h = (k/90)^2 pi/2, theta_d = k pi/180, phi_d = k pi/180 (or 2 pi k/360).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smx {

using Rgb = std::array<double, 3>;

// Cosines of theta_i, theta_o, theta_h and theta_d of a direction pair: all that an isotropic lobe needs.
struct Cosines {
    double i, o, h, d;
};

class Brdf {
  public:
    static constexpr std::size_t theta_h_count = 90;
    static constexpr std::size_t theta_d_count = 90;

    // values: [3][90][90][phi_d_count] in 1/sr; cells with a negative channel are invalid and get filled
    // (fill_holes.h). Throws BadFormat for a NaN, an infinity or a table with no valid cell.
    Brdf(std::string name, std::string source, std::string sha256, std::size_t phi_d_count, std::vector<double> values);

    std::size_t phi_d_count() const { return phi_d_count_; }
    std::size_t cells() const { return theta_h_count * theta_d_count * phi_d_count_; }
    std::size_t cell(std::size_t theta_h, std::size_t theta_d, std::size_t phi_d) const {
        return (theta_h * theta_d_count + theta_d) * phi_d_count_ + phi_d;
    }
    double value(std::size_t channel, std::size_t cell) const { return values_[channel * cells() + cell]; }
    bool valid(std::size_t cell) const { return valid_[cell]; }

    // Angles of the nodes.
    static double theta_h(std::size_t k);
    static double theta_d(std::size_t k);
    double phi_d(std::size_t k) const;

    // Of the direction pair at the nodes, phi_d < 360. Not clamped: below the horizon they are negative.
    static Cosines cosines(std::size_t theta_h, std::size_t theta_d, std::size_t phi_d);

    // The cell's direction pair lies above the horizon.
    static bool above_horizon(std::size_t theta_h, std::size_t theta_d, std::size_t phi_d);

    // Weight of theta_h node k in a quadrature of sin(theta) dtheta, with theta = u^2 pi/2 on equidistant u: the
    // trapezoid rule's. That of node 0 would be zero; it gets a linear interpolant's first half cell, integral of (1 -
    // u/h) theta dtheta, so that a mirror, whose mass is all in node 0, has mass.
    static double theta_h_weight(std::size_t k);

    std::size_t invalid_cells() const { return invalid_cells_; }
    std::size_t filled_cells() const { return filled_cells_; } // invalid ones above the horizon

    const std::vector<double> &values() const { return values_; }
    const std::string &name() const { return name_; }
    const std::string &source() const { return source_; } // path, "builtin:NAME", "analytic:..." or "memory"
    const std::string &sha256() const { return sha256_; }

  private:
    void find_valid_cells();

    std::string name_, source_, sha256_;
    std::size_t phi_d_count_;
    std::vector<double> values_;
    std::vector<bool> valid_;
    std::size_t invalid_cells_ = 0, filled_cells_ = 0;
};

} // namespace smx
