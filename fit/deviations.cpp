#include "deviations.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <optional>

#include "per_lobe_problem.h"

namespace smx {

namespace {

// A coefficient of less than this share of its channel's largest is at its bound: the solver stops beside it.
constexpr double at_bound = 1e-6;

double largest(const PerLobeFit &fit, std::size_t channel) {
    double value = 0.0;
    for (const CurveCoefficients &curves : fit.curves)
        for (double coefficient : curves[channel]) value = std::max(value, coefficient);
    return value;
}

bool has_energy(const PerLobeFit &fit, std::size_t k) {
    for (std::size_t c = 0; c < 3; ++c)
        for (double coefficient : fit.curves[k][c])
            if (coefficient > at_bound * largest(fit, c)) return true;
    return false;
}

// A block of the problem and which of its parameters are free.
struct Block {
    double *values;
    std::vector<bool> free;

    std::size_t free_count() const { return static_cast<std::size_t>(std::count(free.begin(), free.end(), true)); }
};

// Log alphas first, then [channel][coefficient].
std::vector<Block> blocks_of(Unknowns &unknowns, const PerLobeFit &fit) {
    std::vector<Block> blocks = {{unknowns.log_alphas.data(), {}}};
    for (std::size_t k = 0; k < fit.alphas.size(); ++k)
        blocks[0].free.push_back(has_energy(fit, k) && fit.alphas[k] > min_alpha && fit.alphas[k] < max_alpha);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::vector<double> &lobes : unknowns.values[c]) {
            blocks.push_back({lobes.data(), {}});
            for (double value : lobes) blocks.back().free.push_back(value > at_bound * largest(fit, c));
        }
    return blocks;
}

void hold_bound(ceres::Problem &problem, const Block &block) {
    std::vector<int> held;
    for (std::size_t k = 0; k < block.free.size(); ++k)
        if (!block.free[k]) held.push_back(static_cast<int>(k));
    if (held.size() == block.free.size())
        problem.SetParameterBlockConstant(block.values);
    else if (!held.empty())
        problem.SetManifold(block.values, new ceres::SubsetManifold(static_cast<int>(block.free.size()), held));
}

// Variances of all parameters, [block][parameter], 0 of those that are held.
using Variances = std::vector<std::vector<double>>;

// The problem's derivatives by its free parameters, block by block.
Eigen::SparseMatrix<double> jacobian(ceres::Problem &problem, const std::vector<Block> &blocks) {
    ceres::Problem::EvaluateOptions order;
    for (const Block &block : blocks)
        if (block.free_count() > 0) order.parameter_blocks.push_back(block.values);
    ceres::CRSMatrix rows;
    problem.Evaluate(order, nullptr, nullptr, nullptr, &rows);
    return Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
        rows.num_rows, rows.num_cols, static_cast<Eigen::Index>(rows.values.size()), rows.rows.data(), rows.cols.data(),
        rows.values.data());
}

// Diagonal of the inverse of J'J = P R'R P', as squared norms of the rows of R's inverse; nothing where J does not
// determine all parameters. (Ceres's own covariance writes to stderr there.)
std::optional<Variances> by_qr(ceres::Problem &problem, const std::vector<Block> &blocks) {
    const Eigen::SparseMatrix<double> j = jacobian(problem, blocks);
    const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr(j);
    const Eigen::Index n = j.cols();
    if (qr.info() != Eigen::Success || qr.rank() < n) return {};
    const Eigen::SparseMatrix<double, Eigen::RowMajor> sorted = qr.matrixR(); // its own columns are not
    const Eigen::SparseMatrix<double> r = sorted.topLeftCorner(n, n);
    std::vector<double> free(static_cast<std::size_t>(n));
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::VectorXd row = r.transpose().triangularView<Eigen::Lower>().solve(Eigen::VectorXd::Unit(n, k));
        free[static_cast<std::size_t>(qr.colsPermutation().indices()[k])] = row.squaredNorm();
    }
    Variances variances;
    auto next = free.begin();
    for (const Block &block : blocks) {
        variances.emplace_back();
        for (const bool is_free : block.free) variances.back().push_back(is_free ? *next++ : 0.0);
    }
    return variances;
}

// The same from the pseudo-inverse, which drops what nothing determines: slow.
std::optional<Variances> by_svd(ceres::Problem &problem, const std::vector<Block> &blocks) {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.null_space_rank = -1;
    ceres::Covariance covariance(options);
    std::vector<std::pair<const double *, const double *>> pairs;
    for (const Block &block : blocks)
        if (block.free_count() > 0) pairs.emplace_back(block.values, block.values);
    if (!covariance.Compute(pairs, &problem)) return {};
    Variances variances;
    for (const Block &block : blocks) {
        const std::size_t n = block.free.size();
        std::vector<double> matrix(n * n, 0.0);
        if (block.free_count() > 0) covariance.GetCovarianceBlock(block.values, block.values, matrix.data());
        variances.emplace_back();
        for (std::size_t k = 0; k < n; ++k) variances.back().push_back(matrix[k * n + k]);
    }
    return variances;
}

} // namespace

Deviations deviations(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit, double scale) {
    PerLobeProblem posed(levels, fit);
    const std::vector<Block> blocks = blocks_of(posed.unknowns(), fit);
    std::size_t free = 0, samples = 0;
    for (const Block &block : blocks) {
        hold_bound(posed.problem(), block);
        free += block.free_count();
    }
    for (const DirectionLevel &level : levels) samples += 3 * level.samples.size();
    double half_square = 0.0;
    posed.problem().Evaluate({}, &half_square, nullptr, nullptr, nullptr);

    if (free == 0 || samples <= free) return {};
    std::optional<Variances> variances = by_qr(posed.problem(), blocks);
    if (!variances) variances = by_svd(posed.problem(), blocks);
    if (!variances) return {};
    const double residual_variance = 2 * half_square / static_cast<double>(samples - free);
    const auto deviation = [&](std::size_t block, std::size_t k) {
        return blocks[block].free[k] ? std::sqrt(residual_variance * (*variances)[block][k]) : Deviations::held;
    };
    Deviations result;
    for (std::size_t k = 0; k < fit.alphas.size(); ++k) {
        const double log_alpha = deviation(0, k);
        result.alpha.push_back(log_alpha == Deviations::held ? log_alpha : fit.alphas[k] * log_alpha);
        result.curves.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t j = 0; j < curve_coefficients; ++j) {
                const double coefficient = deviation(1 + c * curve_coefficients + j, k);
                result.curves[k][c].push_back(coefficient == Deviations::held ? coefficient : scale * coefficient);
            }
    }
    return result;
}

} // namespace smx
