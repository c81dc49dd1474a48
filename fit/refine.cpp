#include "refine.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "ceres_solver.h"
#include "em.h"

namespace smx {

namespace {

// Residual of one node and its derivative by the logarithm of the mixture there.
struct Deviance {
    double residual, derivative;
};

Deviance deviance(double mass, double p22, double area, double log_mixture) {
    const double mixture_mass = area * std::exp(log_mixture);
    const double t = log_mixture - (mass > 0.0 ? std::log(p22) : 0.0);
    // Near the minimum the difference below cancels: e^t - 1 - t = t^2 / 2 + t^3 / 6 + ...
    if (mass > 0.0 && std::abs(t) < 1e-3) {
        const double root = std::sqrt(mass);
        return {root * t * (1.0 + t / 6.0), root * (1.0 + t / 3.0)};
    }
    const double half = mass > 0.0 ? mixture_mass - mass - mass * t : mixture_mass;
    const double residual = std::copysign(std::sqrt(2.0 * std::max(half, 0.0)), mixture_mass - mass);
    return {residual, residual != 0.0 ? (mixture_mass - mass) / residual : 0.0};
}

// Parameters: log alphas, then log weights up to a common constant.
class DevianceResiduals : public ceres::CostFunction {
  public:
    DevianceResiduals(const SlopeDensity &density, int lobes)
        : density_(density), lobes_(static_cast<std::size_t>(lobes)) {
        *mutable_parameter_block_sizes() = {lobes, lobes};
        set_num_residuals(static_cast<int>(density.slope.size()));
    }

    bool Evaluate(double const *const *parameters, double *residuals, double **jacobians) const override {
        std::vector<double> logs(lobes_), log_weight(lobes_);
        const double log_total = log_sum_exp({parameters[1], parameters[1] + lobes_});
        for (std::size_t k = 0; k < lobes_; ++k) log_weight[k] = parameters[1][k] - log_total;
        for (std::size_t j = 0; j < density_.slope.size(); ++j) {
            const double s = density_.slope[j] * density_.slope[j];
            for (std::size_t k = 0; k < lobes_; ++k)
                logs[k] = log_weight[k] - s * std::exp(-2 * parameters[0][k]) - 2 * parameters[0][k] -
                          std::log(std::numbers::pi);
            const double log_mixture = log_sum_exp(logs);
            const auto [residual, derivative] =
                deviance(density_.mass[j], density_.p22[j], density_.area[j], log_mixture);
            residuals[j] = residual;
            for (std::size_t k = 0; k < lobes_; ++k) {
                const double share = std::exp(logs[k] - log_mixture);
                const std::size_t at = j * lobes_ + k;
                if (jacobians && jacobians[0])
                    jacobians[0][at] = derivative * share * 2 * (s * std::exp(-2 * parameters[0][k]) - 1.0);
                if (jacobians && jacobians[1]) jacobians[1][at] = derivative * (share - std::exp(log_weight[k]));
            }
        }
        return true;
    }

  private:
    const SlopeDensity &density_;
    std::size_t lobes_;
};

// The lobes as the solver sees them.
struct Parameters {
    std::vector<double> log_alpha, log_weight;

    explicit Parameters(const std::vector<Lobe> &lobes) {
        for (const Lobe &lobe : lobes) {
            log_alpha.push_back(std::log(lobe.alpha));
            log_weight.push_back(std::log(lobe.weight));
        }
    }

    std::vector<Lobe> lobes() const {
        const double top = *std::max_element(log_weight.begin(), log_weight.end());
        std::vector<Lobe> lobes;
        for (std::size_t k = 0; k < log_alpha.size(); ++k) {
            const double weight = std::exp(log_weight[k] - top);
            if (weight > 0.0) lobes.push_back({weight, std::clamp(std::exp(log_alpha[k]), min_alpha, max_alpha)});
        }
        canonicalise(lobes);
        return lobes;
    }
};

// What the problem refers to is not Ceres's, which would lose it where memory ends.
ceres::Problem::Options owning_nothing() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
}

void pose(ceres::Problem &problem, Parameters &p, DevianceResiduals &residuals,
          std::unique_ptr<ceres::Manifold> &manifold) {
    const int n = static_cast<int>(p.log_alpha.size());
    problem.AddResidualBlock(&residuals, nullptr, p.log_alpha.data(), p.log_weight.data());
    for (int k = 0; k < n; ++k) {
        problem.SetParameterLowerBound(p.log_alpha.data(), k, std::log(min_alpha));
        problem.SetParameterUpperBound(p.log_alpha.data(), k, std::log(max_alpha));
    }
    // The weights are free up to a common factor, so that of the heaviest lobe is held.
    const auto heaviest = std::max_element(p.log_weight.begin(), p.log_weight.end()) - p.log_weight.begin();
    if (n == 1) return problem.SetParameterBlockConstant(p.log_weight.data());
    manifold = std::make_unique<ceres::SubsetManifold>(n, std::vector<int>{static_cast<int>(heaviest)});
    problem.SetManifold(p.log_weight.data(), manifold.get());
}

} // namespace

RefineResult refine(const std::vector<Lobe> &start, const SlopeDensity &density) {
    Parameters parameters(start);
    DevianceResiduals residuals(density, static_cast<int>(start.size()));
    std::unique_ptr<ceres::Manifold> manifold;
    ceres::Problem problem(owning_nothing());
    pose(problem, parameters, residuals, manifold);

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-12;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    RefineResult result{start, static_cast<unsigned>(summary.num_successful_steps), summary.message};
    if (summary.IsSolutionUsable()) result.lobes = parameters.lobes();
    return result;
}

double hellinger(const std::vector<Lobe> &lobes, const SlopeDensity &density) {
    double sum = 0.0;
    for (std::size_t j = 0; j < density.slope.size(); ++j) {
        const double s = density.slope[j] * density.slope[j];
        const double difference = std::sqrt(density.p22[j]) - std::exp(log_p22(lobes, s) / 2);
        sum += density.area[j] * difference * difference;
    }
    return std::sqrt(sum / 2);
}

} // namespace smx
