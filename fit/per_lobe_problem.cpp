#include "per_lobe_problem.h"

#include <algorithm>
#include <cmath>

#include "curve_basis.h"
#include "material.h"

namespace smx {

namespace {

using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Of the albedo's relative excess, beside residuals whose sum of squares is that of a relative error: an excess of 0.1
// % weighs as much as 1 % of error everywhere.
constexpr double energy_penalty = 10.0;

// One level and channel. Parameters: log alphas, then the lobes' three coefficients that make the curve at theta_d.
class LevelResiduals : public ceres::CostFunction {
  public:
    LevelResiduals(const CompressedLevels &levels, std::size_t index, std::size_t channel)
        : levels_(levels), index_(index), channel_(channel), share_(curve_shares(levels.theta_d(index)).weight) {
        const int n = static_cast<int>(levels.lobes());
        *mutable_parameter_block_sizes() = {n, n, n, n};
        set_num_residuals(static_cast<int>(levels.rows()));
    }
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        const Eigen::Index n = levels_.lobes(), rows = levels_.rows();
        Eigen::Map<VectorXd> r(residuals, rows);
        r = -levels_.data(index_, channel_);
        for (Eigen::Index k = 0; k < n; ++k) r += curve(p, k) * levels_.lobe(index_, k);
        for (Eigen::Index k = 0; jacobians && k < n; ++k) {
            if (jacobians[0])
                Eigen::Map<RowMajor>(jacobians[0], rows, n).col(k) = curve(p, k) * levels_.derivative(index_, k);
            for (std::size_t a = 0; a < 3; ++a)
                if (jacobians[1 + a])
                    Eigen::Map<RowMajor>(jacobians[1 + a], rows, n).col(k) = share_[a] * levels_.lobe(index_, k);
        }
        return true;
    }

  private:
    double curve(double const *const *p, Eigen::Index k) const {
        return share_[0] * p[1][k] + share_[1] * p[2][k] + share_[2] * p[3][k];
    }

    const CompressedLevels &levels_;
    std::size_t index_, channel_;
    std::array<double, 3> share_;
};

// Second differences of all lobes over three coefficients, in proportion to each lobe's weight in the data.
class RoughnessResiduals : public ceres::CostFunction {
  public:
    explicit RoughnessResiduals(std::vector<double> scales) : scales_(std::move(scales)) {
        const int n = static_cast<int>(scales_.size());
        *mutable_parameter_block_sizes() = {n, n, n};
        set_num_residuals(n);
    }
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        const std::size_t n = scales_.size();
        for (std::size_t k = 0; k < n; ++k) {
            residuals[k] = 0.0;
            for (std::size_t a = 0; a < 3; ++a) residuals[k] += scales_[k] * difference[a] * p[a][k];
        }
        for (std::size_t a = 0; jacobians && a < 3; ++a)
            for (std::size_t k = 0; jacobians[a] && k < n * n; ++k)
                jacobians[a][k] = k / n == k % n ? scales_[k / n] * difference[a] : 0.0;
        return true;
    }

  private:
    static constexpr double difference[3] = {1.0, -2.0, 1.0};
    std::vector<double> scales_;
};

// What the albedo towards one direction has beyond its bound. Parameters: all coefficients of one channel.
class EnergyResidual : public ceres::CostFunction {
  public:
    EnergyResidual(Eigen::MatrixXd shares, double bound) : shares_(std::move(shares)), bound_(bound) {
        mutable_parameter_block_sizes()->assign(curve_coefficients, static_cast<int>(shares_.cols()));
        set_num_residuals(1);
    }
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        double albedo = 0.0;
        for (Eigen::Index j = 0; j < shares_.rows(); ++j)
            for (Eigen::Index k = 0; k < shares_.cols(); ++k) albedo += shares_(j, k) * p[j][k];
        const double pull = albedo > bound_ ? energy_penalty / bound_ : 0.0;
        residuals[0] = pull * (albedo - bound_);
        for (Eigen::Index j = 0; jacobians && j < shares_.rows(); ++j)
            for (Eigen::Index k = 0; jacobians[j] && k < shares_.cols(); ++k) jacobians[j][k] = pull * shares_(j, k);
        return true;
    }

  private:
    Eigen::MatrixXd shares_;
    double bound_;
};

} // namespace

Unknowns::Unknowns(const PerLobeFit &fit) {
    for (double alpha : fit.alphas) log_alphas.push_back(std::log(alpha));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t j = 0; j < curve_coefficients; ++j) {
            values[c].emplace_back();
            for (const CurveCoefficients &curves : fit.curves) values[c][j].push_back(curves[c][j]);
        }
}

PerLobeFit Unknowns::fit() const {
    PerLobeFit out;
    for (std::size_t k = 0; k < log_alphas.size(); ++k) {
        out.alphas.push_back(
            std::clamp(std::exp(log_alphas[k]), min_alpha, max_alpha)); // exp(log(bound)) may round out
        out.curves.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            for (const std::vector<double> &lobes : values[c]) out.curves[k][c].push_back(std::max(lobes[k], 0.0));
    }
    return out;
}

PerLobeProblem::PerLobeProblem(const std::vector<DirectionLevel> &levels, const PerLobeFit &start,
                               const std::vector<EnergyBound> &energy)
    : unknowns_(start), levels_(levels) {
    levels_.update(unknowns_.log_alphas);
    ceres::Problem::Options options;
    options.evaluation_callback = this;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    problem_ = std::make_unique<ceres::Problem>(options);
    for (std::size_t c = 0; c < 3; ++c) {
        add_levels(c);
        add_roughness(c);
        for (const EnergyBound &bound : energy) add_energy(bound, c);
    }
    add_bounds();
    if (!energy.empty()) problem_->SetParameterBlockConstant(unknowns_.log_alphas.data());
}

void PerLobeProblem::PrepareForEvaluation(bool, bool new_point) {
    if (new_point) levels_.update(unknowns_.log_alphas);
}

void PerLobeProblem::add(std::unique_ptr<ceres::CostFunction> residuals, const std::vector<double *> &blocks) {
    residuals_.push_back(std::move(residuals));
    problem_->AddResidualBlock(residuals_.back().get(), nullptr, blocks);
}

void PerLobeProblem::add_levels(std::size_t channel) {
    auto &values = unknowns_.values[channel];
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const std::size_t first = curve_shares(levels_.theta_d(l)).first;
        add(std::make_unique<LevelResiduals>(levels_, l, channel),
            {unknowns_.log_alphas.data(), values[first].data(), values[first + 1].data(), values[first + 2].data()});
    }
}

void PerLobeProblem::add_roughness(std::size_t channel) {
    // A lobe's roughness is measured by its mean square in the data per coefficient.
    std::vector<double> scales;
    for (Eigen::Index k = 0; k < levels_.lobes(); ++k) {
        double seen = 0.0;
        for (std::size_t l = 0; l < levels_.size(); ++l) seen += levels_.lobe(l, k).squaredNorm();
        scales.push_back(std::sqrt(smoothness * seen / static_cast<double>(curve_coefficients)));
    }
    auto &values = unknowns_.values[channel];
    for (std::size_t j = 0; j + 2 < curve_coefficients; ++j)
        add(std::make_unique<RoughnessResiduals>(scales),
            {values[j].data(), values[j + 1].data(), values[j + 2].data()});
}

void PerLobeProblem::add_energy(const EnergyBound &energy, std::size_t channel) {
    std::vector<double *> blocks;
    for (std::vector<double> &lobes : unknowns_.values[channel]) blocks.push_back(lobes.data());
    add(std::make_unique<EnergyResidual>(energy.shares, energy.bound[channel]), blocks);
}

void PerLobeProblem::add_bounds() {
    for (int k = 0; k < static_cast<int>(levels_.lobes()); ++k) {
        problem_->SetParameterLowerBound(unknowns_.log_alphas.data(), k, std::log(min_alpha));
        problem_->SetParameterUpperBound(unknowns_.log_alphas.data(), k, std::log(max_alpha));
        for (auto &channel : unknowns_.values)
            for (std::vector<double> &lobes : channel) problem_->SetParameterLowerBound(lobes.data(), k, 0.0);
    }
}

} // namespace smx
