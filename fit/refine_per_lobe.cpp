#include "refine_per_lobe.h"

#include <algorithm>
#include <cmath>

#include "ceres_solver.h"
#include "curve_basis.h"
#include "lobe_value.h"
#include "material.h"

namespace smx {

namespace {

// A sample whose error is more than this share of its whole level's value is taken for a fault of the table, and its
// pull falls off: half at the scale, then as its inverse.
constexpr double cauchy_scale = 0.1;

// The lobes at every sample, computed once per evaluation point for all channels.
class LobeCache : public ceres::EvaluationCallback {
  public:
    LobeCache(const std::vector<DirectionLevel> &levels, const std::vector<double> &log_alphas)
        : levels_(levels), log_alphas_(log_alphas) {
        for (const DirectionLevel &level : levels) values_.emplace_back(level.samples.size() * log_alphas.size());
    }
    void PrepareForEvaluation(bool, bool new_point) override {
        if (!new_point) return;
        const std::size_t n = log_alphas_.size();
        for (std::size_t k = 0; k < n; ++k) {
            const double alpha = std::exp(log_alphas_[k]);
            for (std::size_t l = 0; l < levels_.size(); ++l)
                for (std::size_t s = 0; s < levels_[l].samples.size(); ++s)
                    values_[l][s * n + k] = lobe_value(levels_[l].samples[s], alpha);
        }
    }
    const LobeValue *at(std::size_t level, std::size_t sample) const {
        return values_[level].data() + sample * log_alphas_.size();
    }

  private:
    const std::vector<DirectionLevel> &levels_;
    const std::vector<double> &log_alphas_;
    std::vector<std::vector<LobeValue>> values_;
};

// Residual with a Cauchy loss per sample, as a least-squares term: its square is scale^2 log(1 + (r / scale)^2).
struct Robust {
    double residual, derivative;
};

Robust robust(double r, double scale) {
    const double x = r / scale, x2 = x * x;
    if (x2 < 1e-8) return {r, 1.0}; // the quotient below is 0 / 0 at 0, and 1 - 3/4 x2 near it
    const double root = std::sqrt(std::log1p(x2));
    return {std::copysign(scale * root, r), std::abs(x) / (root * (1.0 + x2))};
}

// One level and channel. Parameters: log alphas, then the lobes' three coefficients that make the curve at theta_d.
class LevelResiduals : public ceres::CostFunction {
  public:
    LevelResiduals(const LobeCache &cache, const DirectionLevel &level, std::size_t index, std::size_t channel,
                   int lobes)
        : cache_(cache), level_(level), index_(index), channel_(channel), share_(curve_shares(level.theta_d).weight) {
        *mutable_parameter_block_sizes() = {lobes, lobes, lobes, lobes};
        set_num_residuals(static_cast<int>(level.samples.size()));
    }
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        const auto n = static_cast<std::size_t>(parameter_block_sizes()[0]);
        for (std::size_t s = 0; s < level_.samples.size(); ++s) {
            const DirectionSample &sample = level_.samples[s];
            const LobeValue *lobes = cache_.at(index_, s);
            double model = 0.0;
            for (std::size_t k = 0; k < n; ++k) model += curve(p, k) * lobes[k].value;
            const auto [residual, derivative] =
                robust(sample.weight * (model - sample.f[channel_]), cauchy_scale * level_.norm);
            residuals[s] = residual;
            if (!jacobians) continue;
            const double pull = derivative * sample.weight;
            for (std::size_t k = 0; k < n; ++k) {
                if (jacobians[0]) jacobians[0][s * n + k] = pull * curve(p, k) * lobes[k].derivative;
                for (std::size_t a = 0; a < 3; ++a)
                    if (jacobians[1 + a]) jacobians[1 + a][s * n + k] = pull * share_[a] * lobes[k].value;
            }
        }
        return true;
    }

  private:
    double curve(double const *const *p, std::size_t k) const {
        return share_[0] * p[1][k] + share_[1] * p[2][k] + share_[2] * p[3][k];
    }

    const LobeCache &cache_;
    const DirectionLevel &level_;
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
std::vector<double> roughness_scales(const std::vector<DirectionLevel> &levels, const LobeCache &cache,
                                     std::size_t lobes) {
    std::vector<double> scales(lobes, 0.0);
    for (std::size_t l = 0; l < levels.size(); ++l)
        for (std::size_t s = 0; s < levels[l].samples.size(); ++s)
            for (std::size_t k = 0; k < lobes; ++k) {
                const double seen = levels[l].samples[s].weight * cache.at(l, s)[k].value;
                scales[k] += seen * seen;
            }
    for (double &scale : scales) scale = std::sqrt(smoothness * scale / static_cast<double>(curve_coefficients));
    return scales;
}

void pose(ceres::Problem &problem, Unknowns &u, const LobeCache &cache, const std::vector<DirectionLevel> &levels,
          const std::vector<double> &scales) {
    const int n = static_cast<int>(u.log_alphas.size());
    for (std::size_t c = 0; c < 3; ++c) {
        auto &values = u.values[c];
        for (std::size_t l = 0; l < levels.size(); ++l) {
            const std::size_t first = curve_shares(levels[l].theta_d).first;
            problem.AddResidualBlock(new LevelResiduals(cache, levels[l], l, c, n), nullptr, u.log_alphas.data(),
                                     values[first].data(), values[first + 1].data(), values[first + 2].data());
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
    LobeCache cache(levels, unknowns.log_alphas);
    cache.PrepareForEvaluation(true, true);
    const auto scales = roughness_scales(levels, cache, start.alphas.size());

    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &cache;
    ceres::Problem problem(problem_options);
    pose(problem, unknowns, cache, levels, scales);

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 8;
    options.function_tolerance = 1e-3;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    PerLobeRefinement result{start, static_cast<unsigned>(summary.num_successful_steps), summary.message};
    if (summary.IsSolutionUsable()) result.fit = unknowns.fit();
    return result;
}

} // namespace smx
