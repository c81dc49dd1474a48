#include "lobe_curves.h"

#include <Eigen/Dense>
#include <utility>

#include "ceres_solver.h"
#include "curve_basis.h"
#include "error.h"
#include "lobe_value.h"

namespace smx {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Normal equations of one channel set: the matrix is common, as the weights are; unknown (coefficient j, lobe k) is at
// j n + k.
struct NormalEquations {
    MatrixXd gram;
    std::array<VectorXd, 3> right;
    VectorXd seen; // each lobe's sum of squares in the data
};

void add_level(NormalEquations &eq, const DirectionLevel &level, const std::vector<double> &alphas) {
    const auto n = static_cast<Eigen::Index>(alphas.size());
    MatrixXd gram = MatrixXd::Zero(n, n);
    std::array<VectorXd, 3> right = {VectorXd::Zero(n), VectorXd::Zero(n), VectorXd::Zero(n)};
    VectorXd lobes(n);
    for (const DirectionSample &s : level.samples) {
        for (Eigen::Index k = 0; k < n; ++k)
            lobes[k] = s.weight * lobe_value(s, alphas[static_cast<std::size_t>(k)]).value;
        gram.selfadjointView<Eigen::Lower>().rankUpdate(lobes);
        eq.seen += lobes.cwiseAbs2();
        for (std::size_t c = 0; c < 3; ++c) right[c] += lobes * (s.weight * s.f[c]);
    }
    gram = gram.selfadjointView<Eigen::Lower>();

    const auto [first, weight] = curve_shares(level.theta_d);
    for (std::size_t a = 0; a < 3; ++a) {
        const auto row = static_cast<Eigen::Index>(first + a) * n;
        for (std::size_t b = 0; b < 3; ++b)
            eq.gram.block(row, static_cast<Eigen::Index>(first + b) * n, n, n) += weight[a] * weight[b] * gram;
        for (std::size_t c = 0; c < 3; ++c) eq.right[c].segment(row, n) += weight[a] * right[c];
    }
}

void add_smoothness(NormalEquations &eq, Eigen::Index n) {
    constexpr auto count = static_cast<Eigen::Index>(curve_coefficients);
    constexpr double difference[3] = {1.0, -2.0, 1.0};
    for (Eigen::Index k = 0; k < n; ++k) {
        const double scale = eq.seen[k] / static_cast<double>(count);
        for (Eigen::Index j = 0; j + 2 < count; ++j)
            for (Eigen::Index a = 0; a < 3; ++a)
                for (Eigen::Index b = 0; b < 3; ++b)
                    eq.gram((j + a) * n + k, (j + b) * n + k) += smoothness * scale * difference[a] * difference[b];
    }
}

// || upper x - y ||, linear.
class LinearResiduals : public ceres::CostFunction {
  public:
    LinearResiduals(const MatrixXd &upper, VectorXd y) : upper_(upper), y_(std::move(y)) {
        mutable_parameter_block_sizes()->push_back(static_cast<int>(upper.cols()));
        set_num_residuals(static_cast<int>(upper.rows()));
    }
    bool Evaluate(double const *const *x, double *residuals, double **jacobians) const override {
        const Eigen::Map<const VectorXd> unknowns(x[0], upper_.cols());
        Eigen::Map<VectorXd>(residuals, upper_.rows()) = upper_ * unknowns - y_;
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        if (jacobians && jacobians[0]) Eigen::Map<RowMajor>(jacobians[0], upper_.rows(), upper_.cols()) = upper_;
        return true;
    }

  private:
    const MatrixXd &upper_;
    VectorXd y_;
};

VectorXd solve_non_negative(const MatrixXd &upper, const VectorXd &y) {
    VectorXd x = upper.triangularView<Eigen::Upper>().solve(y).cwiseMax(0.0);
    ceres::Problem problem;
    problem.AddResidualBlock(new LinearResiduals(upper, y), nullptr, x.data());
    for (int k = 0; k < x.size(); ++k) problem.SetParameterLowerBound(x.data(), k, 0.0);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 60;
    options.function_tolerance = 1e-7;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return x.cwiseMax(0.0);
}

} // namespace

std::vector<CurveCoefficients> fit_curves(const std::vector<DirectionLevel> &levels,
                                          const std::vector<double> &alphas) {
    const auto n = static_cast<Eigen::Index>(alphas.size()), size = n * static_cast<Eigen::Index>(curve_coefficients);
    const VectorXd zero = VectorXd::Zero(size);
    NormalEquations eq{MatrixXd::Zero(size, size), {zero, zero, zero}, VectorXd::Zero(n)};
    for (const DirectionLevel &level : levels) add_level(eq, level, alphas);
    add_smoothness(eq, n);
    // A lobe that no sample sees has no curve of its own: the least that keeps the matrix definite draws it to 0.
    eq.gram.diagonal().array() += 1e-10 * eq.gram.trace() / static_cast<double>(size);

    const Eigen::LLT<MatrixXd> factor(eq.gram);
    if (factor.info() != Eigen::Success) fail(Fault::NoSolution, "the lobes' curves are not determined by the table");
    const MatrixXd upper = factor.matrixU();
    std::vector<CurveCoefficients> curves(alphas.size());
    for (std::size_t c = 0; c < 3; ++c) {
        const VectorXd x = solve_non_negative(upper, factor.matrixL().solve(eq.right[c]));
        for (std::size_t k = 0; k < alphas.size(); ++k)
            for (std::size_t j = 0; j < curve_coefficients; ++j)
                curves[k][c].push_back(x[static_cast<Eigen::Index>(j) * n + static_cast<Eigen::Index>(k)]);
    }
    return curves;
}

} // namespace smx
