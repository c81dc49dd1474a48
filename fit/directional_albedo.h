// Directional albedo, the share of the light from one direction that a material reflects, of a table and of fits to it.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <numbers>
#include <vector>

#include "brdf.h"
#include "material.h"
#include "per_lobe_fit.h"

namespace smx {

// The integral of f cos_i over wi, on the table's own theta_h nodes (which resolve its peaks) with wo fixed: wi = 2
// <o,h> h - o, dwi = 4 <o,h> dwh. Table and fit are summed over the same nodes.
class DirectionalAlbedo {
  public:
    // Of wo. Nearer the horizon a table's rows of theta_d do not resolve what they hold.
    static constexpr std::array<double, albedo_angles> theta_o_degrees = {0, 15, 30, 45, 55, 65, 75, 80};

    explicit DirectionalAlbedo(const Brdf &brdf);

    // By theta_o.
    std::vector<Rgb> of_table() const;
    std::vector<Rgb> of(const Material &material) const;

    // What a fit may reflect at most: 1, or where the table itself has more, the table's.
    std::vector<Rgb> bound() const;

    // By theta_o, of lobes of these alphas with a curve of a single coefficient 1: [coefficient][lobe]. A fit's albedo
    // is the sum over its coefficients times these.
    std::vector<Eigen::MatrixXd> shares(const std::vector<double> &alphas) const;

  private:
    struct Node {
        DirectionSample sample; // f: the table's; weight: of the integral
        double theta_d;
    };
    std::vector<std::vector<Node>> nodes_; // by theta_o
};

} // namespace smx
