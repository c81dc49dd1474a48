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

void solve(const std::vector<DirectionLevel> &levels, const std::vector<EnergyBound> &energy, unsigned max_iterations,
           PerLobeRefinement &result) {
    PerLobeProblem problem(levels, result.fit, energy);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = static_cast<int>(max_iterations);
    options.function_tolerance = 3e-4;
    options.max_num_line_search_step_size_iterations = 3; // along the bounds: more cost time and gain nothing
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem.problem(), &summary);
    result.iterations += static_cast<unsigned>(summary.num_successful_steps);
    result.message = summary.BriefReport();
    if (summary.IsSolutionUsable()) result.fit = problem.unknowns().fit();
}

std::vector<EnergyBound> energy_bounds(const DirectionalAlbedo &albedo, const std::vector<Rgb> &bound,
                                       const std::vector<double> &alphas) {
    std::vector<EnergyBound> energy;
    for (const Eigen::MatrixXd &shares : albedo.shares(alphas)) energy.push_back({shares, bound[energy.size()]});
    return energy;
}

// Largest factor, at most 1, by which the channel may be scaled to stay within its bound everywhere.
double allowed_scale(const std::vector<EnergyBound> &energy, const PerLobeFit &fit, std::size_t channel) {
    double scale = 1.0;
    for (const EnergyBound &at : energy) {
        double albedo = 0.0;
        for (std::size_t k = 0; k < fit.alphas.size(); ++k)
            for (std::size_t j = 0; j < curve_coefficients; ++j)
                albedo +=
                    fit.curves[k][channel][j] * at.shares(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
        if (albedo * scale > at.bound[channel]) scale = at.bound[channel] / albedo;
    }
    return scale;
}

Rgb allowed_scales(const std::vector<EnergyBound> &energy, const PerLobeFit &fit) {
    return {allowed_scale(energy, fit, 0), allowed_scale(energy, fit, 1), allowed_scale(energy, fit, 2)};
}

} // namespace

void refine_per_lobe(const std::vector<DirectionLevel> &levels, unsigned max_iterations, PerLobeRefinement &result) {
    solve(levels, {}, max_iterations, result);
}

bool reweigh(std::vector<DirectionLevel> &levels, const PerLobeFit &fit) {
    bool any = false;
    for (DirectionLevel &level : levels) {
        const CurveShares shares = curve_shares(level.theta_d);
        for (DirectionSample &s : level.samples) {
            const Rgb model = value_at(fit, shares, s);
            double square = 0.0;
            for (std::size_t c = 0; c < 3; ++c) square += std::pow(s.weight * (model[c] - s.f[c]), 2);
            const double scale2 = std::pow(cauchy_scale * level.norm, 2);
            if (square <= scale2) continue;
            s.weight /= std::sqrt(1.0 + square / scale2);
            any = true;
        }
    }
    return any;
}

void bound_energy(const std::vector<DirectionLevel> &levels, const DirectionalAlbedo &albedo,
                  const std::vector<Rgb> &bound, unsigned max_iterations, PerLobeRefinement &result) {
    const std::vector<EnergyBound> energy = energy_bounds(albedo, bound, result.fit.alphas);
    if (allowed_scales(energy, result.fit) == Rgb{1.0, 1.0, 1.0}) return;
    solve(levels, energy, max_iterations, result);
    const Rgb scales = allowed_scales(energy, result.fit);
    for (CurveCoefficients &curves : result.fit.curves)
        for (std::size_t c = 0; c < 3; ++c)
            for (double &value : curves[c]) value *= scales[c];
}

} // namespace smx
