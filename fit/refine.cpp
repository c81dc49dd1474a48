#include "refine.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <ceres/ceres.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <numbers>

#include "em.h"
#include "error.h"

namespace smx {

namespace {

// parameters[0]: log alphas, parameters[1]: log weights up to a common constant.
struct HellingerResiduals {
    const SlopeDensity &density;
    int lobes;

    template <typename T>
    bool operator()(T const *const *parameters, T *residuals) const {
        using std::exp;
        using std::sqrt;
        T total(0.0);
        for (int k = 0; k < lobes; ++k) total += exp(parameters[1][k]);
        for (std::size_t j = 0; j < density.slope.size(); ++j) {
            const double s = density.slope[j] * density.slope[j];
            T mixture(0.0);
            for (int k = 0; k < lobes; ++k) {
                const T inv_alpha2 = exp(-2.0 * parameters[0][k]);
                mixture += exp(parameters[1][k] - s * inv_alpha2) * inv_alpha2;
            }
            mixture /= std::numbers::pi * total;
            // The root has no derivative at 0, where every lobe underflows; the mixture has no share there.
            const T root = mixture > T(0.0) ? T(sqrt(mixture)) : T(0.0);
            residuals[j] = std::sqrt(density.area[j]) * (std::sqrt(density.p22[j]) - root);
        }
        return true;
    }
};

// The weights are free up to a common factor, so that of the heaviest lobe is held.
ceres::Manifold *hold(std::size_t lobes, std::size_t held) {
    return new ceres::SubsetManifold(static_cast<int>(lobes), {static_cast<int>(held)});
}

}  // namespace

RefineResult refine(const std::vector<Lobe> &start, const SlopeDensity &density) {
    const std::size_t count = start.size();
    std::vector<double> log_alpha, log_weight;
    for (const Lobe &lobe : start) {
        log_alpha.push_back(std::log(lobe.alpha));
        log_weight.push_back(std::log(lobe.weight));
    }

    ceres::Problem problem;
    const int n = static_cast<int>(count);
    auto *cost = new ceres::DynamicAutoDiffCostFunction<HellingerResiduals, 4>(new HellingerResiduals{density, n});
    cost->AddParameterBlock(n);
    cost->AddParameterBlock(n);
    cost->SetNumResiduals(static_cast<int>(density.slope.size()));
    problem.AddResidualBlock(cost, nullptr, log_alpha.data(), log_weight.data());
    for (int k = 0; k < n; ++k) {
        problem.SetParameterLowerBound(log_alpha.data(), k, std::log(min_alpha));
        problem.SetParameterUpperBound(log_alpha.data(), k, std::log(max_alpha));
    }
    const auto heaviest = std::max_element(log_weight.begin(), log_weight.end()) - log_weight.begin();
    if (count == 1) problem.SetParameterBlockConstant(log_weight.data());
    else problem.SetManifold(log_weight.data(), hold(count, static_cast<std::size_t>(heaviest)));

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    RefineResult result;
    result.iterations = static_cast<unsigned>(summary.iterations.size());
    result.message = summary.message;
    if (!summary.IsSolutionUsable()) {
        result.lobes = start;
        return result;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double relative = log_weight[k] - log_weight[static_cast<std::size_t>(heaviest)];
        const Lobe lobe = {std::exp(relative), std::clamp(std::exp(log_alpha[k]), min_alpha, max_alpha)};
        if (lobe.weight > 0.0) result.lobes.push_back(lobe);
    }
    canonicalise(result.lobes);
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

}  // namespace smx
