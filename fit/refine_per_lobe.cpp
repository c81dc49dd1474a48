#include "refine_per_lobe.h"

#include <algorithm>
#include <cmath>

#include "ceres_solver.h"
#include "per_lobe_problem.h"

namespace smx {

namespace {

// A sample whose error is more than this share of its whole level's value is taken for a fault of the table: its
// squared weight falls off, to half at the scale, then as the inverse square.
constexpr double cauchy_scale = 0.1;

constexpr unsigned continued_iterations = 6; // of a problem that only differs a little from the one solved before

// One run of the solver from result.fit.
void solve(const std::vector<DirectionLevel> &levels, const DirectionalAlbedo *bound, unsigned max_iterations,
           PerLobeRefinement &result) {
    PerLobeProblem problem(levels, result.fit, bound);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = static_cast<int>(max_iterations);
    options.function_tolerance = 1e-4;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem.problem(), &summary);
    result.iterations += static_cast<unsigned>(summary.num_successful_steps);
    result.message = summary.BriefReport();
    if (summary.IsSolutionUsable()) result.fit = problem.unknowns().fit();
}

// Lowers the weights of samples that the fit misses by far. Returns whether there were any.
bool reweigh(std::vector<DirectionLevel> &levels, const PerLobeFit &fit) {
    bool any = false;
    for (DirectionLevel &level : levels) {
        const CurveShares shares = curve_shares(level.theta_d);
        for (DirectionSample &s : level.samples) {
            const Rgb model = value_at(fit, shares, s);
            double square = 0.0;
            for (std::size_t c = 0; c < 3; ++c) square += std::pow(s.weight * (model[c] - s.f[c]), 2);
            const double scale = cauchy_scale * level.norm;
            if (square <= scale * scale) continue;
            s.weight /= std::sqrt(1.0 + square / (scale * scale));
            any = true;
        }
    }
    return any;
}

// Largest factor, at most 1, by which the channel may be scaled to stay within its bound everywhere.
double allowed_scale(const std::vector<DirectionalAlbedo::Shares> &shares, const std::vector<Rgb> &bound,
                     const PerLobeFit &fit, std::size_t channel) {
    double scale = 1.0;
    for (std::size_t t = 0; t < shares.size(); ++t) {
        double albedo = 0.0;
        for (std::size_t k = 0; k < fit.alphas.size(); ++k)
            for (std::size_t j = 0; j < curve_coefficients; ++j)
                albedo += fit.curves[k][channel][j] *
                          shares[t].value(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
        if (albedo * scale > bound[t][channel]) scale = bound[t][channel] / albedo;
    }
    return scale;
}

std::array<double, 3> allowed_scales(const DirectionalAlbedo &albedo, const PerLobeFit &fit) {
    const auto shares = albedo.shares(fit.alphas);
    const auto bound = albedo.bound();
    return {allowed_scale(shares, bound, fit, 0), allowed_scale(shares, bound, fit, 1),
            allowed_scale(shares, bound, fit, 2)};
}

} // namespace

PerLobeRefinement refine_per_lobe(const std::vector<DirectionLevel> &levels, const DirectionalAlbedo &albedo,
                                  const PerLobeFit &start, unsigned max_iterations) {
    PerLobeRefinement result{start, 0, {}};
    solve(levels, nullptr, max_iterations, result);

    std::vector<DirectionLevel> reweighed = levels;
    if (reweigh(reweighed, result.fit)) solve(reweighed, nullptr, continued_iterations, result);

    std::array<double, 3> scales = allowed_scales(albedo, result.fit);
    if (*std::min_element(scales.begin(), scales.end()) < 1.0) {
        solve(reweighed, &albedo, continued_iterations, result);
        scales = allowed_scales(albedo, result.fit);
        for (CurveCoefficients &curves : result.fit.curves)
            for (std::size_t c = 0; c < 3; ++c)
                for (double &value : curves[c]) value *= scales[c];
    }
    return result;
}

} // namespace smx
