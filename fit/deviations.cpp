#include "deviations.h"

#include <cmath>

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

// Variances in the free directions' ambient coordinates; false where the problem is too ill-conditioned for this
// method.
bool compute(ceres::Problem &problem, const std::vector<Block> &blocks, ceres::CovarianceAlgorithmType algorithm,
             std::vector<std::vector<double>> &variances) {
    ceres::Covariance::Options options;
    options.algorithm_type = algorithm;
    options.null_space_rank = algorithm == ceres::DENSE_SVD ? -1 : 0; // drop what nothing determines
    ceres::Covariance covariance(options);
    std::vector<std::pair<const double *, const double *>> pairs;
    for (const Block &block : blocks)
        if (block.free_count() > 0) pairs.emplace_back(block.values, block.values);
    if (!covariance.Compute(pairs, &problem)) return false;
    for (const Block &block : blocks) {
        const std::size_t n = block.free.size();
        std::vector<double> matrix(n * n, 0.0);
        if (block.free_count() > 0) covariance.GetCovarianceBlock(block.values, block.values, matrix.data());
        variances.emplace_back();
        for (std::size_t k = 0; k < n; ++k) variances.back().push_back(matrix[k * n + k]);
    }
    return true;
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

    std::vector<std::vector<double>> variances;
    if (free == 0 || samples <= free ||
        (!compute(posed.problem(), blocks, ceres::SPARSE_QR, variances) &&
         !compute(posed.problem(), blocks, ceres::DENSE_SVD, variances)))
        return {};
    const double residual_variance = 2 * half_square / static_cast<double>(samples - free);
    const auto deviation = [&](std::size_t block, std::size_t k) {
        return blocks[block].free[k] ? std::sqrt(residual_variance * variances[block][k]) : Deviations::held;
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
