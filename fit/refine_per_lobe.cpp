#include "refine_per_lobe.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "ceres_solver.h"
#include "curve_basis.h"
#include "lobe_value.h"
#include "material.h"

namespace smx {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the residuals of one level are made of, in an orthonormal basis of the few dimensions that they span: a level
// has hundreds of samples, but model, derivatives and data are combinations of 2 n + 3 columns. The triangular factor R
// of [lobes, their derivatives by log alpha, f_r f_g f_b] has the same inner products, so the same cost, gradient and
// Gauss-Newton matrix, at a thirtieth of the rows.
class CompressedLevels : public ceres::EvaluationCallback {
  public:
    CompressedLevels(const std::vector<DirectionLevel> &levels, const std::vector<double> &log_alphas)
        : levels_(levels), log_alphas_(log_alphas), factors_(levels.size()) {}

    void PrepareForEvaluation(bool, bool new_point) override {
        if (!new_point) return;
        for (std::size_t l = 0; l < levels_.size(); ++l) factors_[l] = factor(levels_[l]);
    }
    Eigen::Index rows() const { return columns(); }
    auto lobe(std::size_t level, Eigen::Index k) const { return factors_[level].col(k); }
    auto derivative(std::size_t level, Eigen::Index k) const { return factors_[level].col(lobes() + k); }
    auto data(std::size_t level, std::size_t channel) const {
        return factors_[level].col(2 * lobes() + static_cast<Eigen::Index>(channel));
    }
    Eigen::Index lobes() const { return static_cast<Eigen::Index>(log_alphas_.size()); }

  private:
    Eigen::Index columns() const { return 2 * lobes() + 3; }

    MatrixXd factor(const DirectionLevel &level) const {
        const Eigen::Index n = lobes(), rows = std::max(static_cast<Eigen::Index>(level.samples.size()), columns());
        MatrixXd m = MatrixXd::Zero(rows, columns());
        for (std::size_t s = 0; s < level.samples.size(); ++s) {
            const DirectionSample &sample = level.samples[s];
            const auto row = static_cast<Eigen::Index>(s);
            for (Eigen::Index k = 0; k < n; ++k) {
                const LobeValue lobe = lobe_value(sample, std::exp(log_alphas_[static_cast<std::size_t>(k)]));
                m(row, k) = sample.weight * lobe.value;
                m(row, n + k) = sample.weight * lobe.derivative;
            }
            for (Eigen::Index c = 0; c < 3; ++c)
                m(row, 2 * n + c) = sample.weight * sample.f[static_cast<std::size_t>(c)];
        }
        const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(m); // in place
        return m.topRows(columns()).triangularView<Eigen::Upper>();
    }

    const std::vector<DirectionLevel> &levels_;
    const std::vector<double> &log_alphas_;
    std::vector<MatrixXd> factors_;
};

// One level and channel. Parameters: log alphas, then the lobes' three coefficients that make the curve at theta_d.
class LevelResiduals : public ceres::CostFunction {
  public:
    LevelResiduals(const CompressedLevels &levels, std::size_t index, double theta_d, std::size_t channel)
        : levels_(levels), index_(index), channel_(channel), share_(curve_shares(theta_d).weight) {
        const int n = static_cast<int>(levels.lobes());
        *mutable_parameter_block_sizes() = {n, n, n, n};
        set_num_residuals(static_cast<int>(levels.rows()));
    }
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const Eigen::Index n = levels_.lobes(), rows = levels_.rows();
        Eigen::Map<VectorXd> r(residuals, rows);
        r = -levels_.data(index_, channel_);
        for (Eigen::Index k = 0; k < n; ++k) r += curve(p, k) * levels_.lobe(index_, k);
        if (!jacobians) return true;
        for (Eigen::Index k = 0; k < n; ++k) {
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

// The unknowns as Ceres holds them: one block of log alphas, and one of the lobes' values per channel and coefficient.
struct Unknowns {
    std::vector<double> log_alphas;
    std::array<std::vector<std::vector<double>>, 3> values; // [channel][coefficient][lobe]

    explicit Unknowns(const PerLobeFit &fit) {
        for (double alpha : fit.alphas) log_alphas.push_back(std::log(alpha));
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t j = 0; j < curve_coefficients; ++j) {
                values[c].emplace_back();
                for (const CurveCoefficients &curves : fit.curves) values[c][j].push_back(curves[c][j]);
            }
    }
    PerLobeFit fit() const {
        PerLobeFit out;
        for (std::size_t k = 0; k < log_alphas.size(); ++k) {
            out.alphas.push_back(std::clamp(std::exp(log_alphas[k]), min_alpha, max_alpha));
            out.curves.emplace_back();
            for (std::size_t c = 0; c < 3; ++c)
                for (const std::vector<double> &lobes : values[c]) out.curves[k][c].push_back(std::max(lobes[k], 0.0));
        }
        return out;
    }
};

// Each lobe's mean square in the data per coefficient, which its roughness is measured by.
std::vector<double> roughness_scales(const CompressedLevels &levels, std::size_t count) {
    std::vector<double> scales;
    for (Eigen::Index k = 0; k < levels.lobes(); ++k) {
        double seen = 0.0;
        for (std::size_t l = 0; l < count; ++l) seen += levels.lobe(l, k).squaredNorm();
        scales.push_back(std::sqrt(smoothness * seen / static_cast<double>(curve_coefficients)));
    }
    return scales;
}

void pose(ceres::Problem &problem, Unknowns &u, const CompressedLevels &compressed,
          const std::vector<DirectionLevel> &levels, const std::vector<double> &scales) {
    const int n = static_cast<int>(u.log_alphas.size());
    for (std::size_t c = 0; c < 3; ++c) {
        auto &values = u.values[c];
        for (std::size_t l = 0; l < levels.size(); ++l) {
            const std::size_t first = curve_shares(levels[l].theta_d).first;
            problem.AddResidualBlock(new LevelResiduals(compressed, l, levels[l].theta_d, c), nullptr,
                                     u.log_alphas.data(), values[first].data(), values[first + 1].data(),
                                     values[first + 2].data());
        }
        for (std::size_t j = 0; j + 2 < curve_coefficients; ++j)
            problem.AddResidualBlock(new RoughnessResiduals(scales), nullptr, values[j].data(), values[j + 1].data(),
                                     values[j + 2].data());
        for (std::vector<double> &lobes : values)
            for (int k = 0; k < n; ++k) problem.SetParameterLowerBound(lobes.data(), k, 0.0);
    }
    for (int k = 0; k < n; ++k) {
        problem.SetParameterLowerBound(u.log_alphas.data(), k, std::log(min_alpha));
        problem.SetParameterUpperBound(u.log_alphas.data(), k, std::log(max_alpha));
    }
}

} // namespace

double brdf_residual(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit) {
    double error2 = 0.0, value2 = 0.0;
    for (const DirectionLevel &level : levels) {
        const auto [first, weight] = curve_shares(level.theta_d);
        for (const DirectionSample &s : level.samples) {
            Rgb difference = s.f;
            for (std::size_t k = 0; k < fit.alphas.size(); ++k) {
                const double value = lobe_value(s, fit.alphas[k]).value;
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t a = 0; a < 3; ++a)
                        difference[c] -= weight[a] * fit.curves[k][c][first + a] * value;
            }
            for (std::size_t c = 0; c < 3; ++c) {
                error2 += s.weight * s.weight * difference[c] * difference[c];
                value2 += s.weight * s.weight * s.f[c] * s.f[c];
            }
        }
    }
    return value2 > 0.0 ? std::sqrt(error2 / value2) : 0.0;
}

PerLobeRefinement refine_per_lobe(const std::vector<DirectionLevel> &levels, const PerLobeFit &start) {
    Unknowns unknowns(start);
    CompressedLevels compressed(levels, unknowns.log_alphas);
    compressed.PrepareForEvaluation(true, true);
    const auto scales = roughness_scales(compressed, levels.size());

    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &compressed;
    ceres::Problem problem(problem_options);
    pose(problem, unknowns, compressed, levels, scales);

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = getenv("ITER") ? atoi(getenv("ITER")) : 8;
    options.function_tolerance = getenv("FTOL") ? atof(getenv("FTOL")) : 1e-5;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    PerLobeRefinement result{start, static_cast<unsigned>(summary.num_successful_steps), summary.message};
    if (summary.IsSolutionUsable()) result.fit = unknowns.fit();
    return result;
}

} // namespace smx
