// The fit's levels without their samples: what their residuals are made of, in an orthonormal basis of the few
// dimensions that these span.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "direction_samples.h"

namespace smx {

// A level has hundreds of samples, but model, derivatives and data are combinations of 2 n + 3 columns, n lobes. The
// triangular factor R of [lobes, their derivatives by log alpha, f_r f_g f_b], weighted, has the same inner products:
// the same cost, gradient and Gauss-Newton matrix, at a thirtieth of the rows.
class CompressedLevels {
  public:
    explicit CompressedLevels(const std::vector<DirectionLevel> &levels) : levels_(levels), factors_(levels.size()) {}

    // For these alphas. Before this is called there are no columns.
    void update(const std::vector<double> &log_alphas);

    std::size_t size() const { return levels_.size(); }
    double theta_d(std::size_t level) const { return levels_[level].theta_d; }
    Eigen::Index lobes() const { return lobes_; }
    Eigen::Index rows() const { return 2 * lobes_ + 3; }

    auto lobe(std::size_t level, Eigen::Index k) const { return factors_[level].col(k); }
    auto derivative(std::size_t level, Eigen::Index k) const { return factors_[level].col(lobes_ + k); }
    auto data(std::size_t level, std::size_t channel) const {
        return factors_[level].col(2 * lobes_ + static_cast<Eigen::Index>(channel));
    }

  private:
    Eigen::MatrixXd factor(const DirectionLevel &level, const std::vector<double> &alphas) const;

    const std::vector<DirectionLevel> &levels_;
    Eigen::Index lobes_ = 0;
    std::vector<Eigen::MatrixXd> factors_;
};

} // namespace smx
