#include "baseline.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "ceres_solver.h"
#include "curve_basis.h"
#include "direction_samples.h"
#include "error.h"
#include "material.h"
#include "microfacet.h"

namespace smx {

namespace {

constexpr double cauchy_scale = 0.1; // of a level's value, as in refine_per_lobe.cpp
constexpr std::array start_alphas = {0.005, 0.015, 0.05, 0.15, 0.4, 1.0};
constexpr std::size_t starts = 2;       // of them, the best
constexpr double max_start_rise = 0.05; // theta_d up to 63 degrees

// One sample, as the baselines see it.
struct Observation {
    Cosines at;
    double rise; // Schlick's, of theta_d
    Rgb f;
    double weight, loss_scale;
};

std::vector<Observation> observations(const Brdf &brdf) {
    std::vector<Observation> all;
    for (const DirectionLevel &level : direction_levels(brdf, curve_levels()))
        for (const DirectionSample &s : level.samples) {
            if (level.norm <= 0.0) continue; // nothing is reflected at this theta_d
            const double cos_d = std::cos(level.theta_d);
            all.push_back({{s.ci, s.co, 1.0 / std::sqrt(1.0 + s.tan2), cos_d},
                           schlick_rise(cos_d),
                           s.f,
                           s.weight,
                           cauchy_scale * level.norm});
        }
    return all;
}

// D G2 / (4 cos_i cos_o).
template <typename T>
T lobe(Baseline kind, const Cosines &at, const T &alpha) {
    if (kind == Baseline::Beckmann)
        return smith_lobe<T>(at, beckmann_ndf(at.h, alpha), beckmann_sigma(at.i, alpha), beckmann_sigma(at.o, alpha));
    return smith_lobe<T>(at, ggx_ndf(at.h, alpha), ggx_sigma(at.i, alpha), ggx_sigma(at.o, alpha));
}

template <typename T>
T value(const T &lobe, double rise, const T &f0, const T &kd) {
    return (f0 + (1.0 - f0) * rise) * lobe + kd / std::numbers::pi;
}

// Ceres's form of one observation.
struct Residual {
    const Observation &o;
    Baseline kind;

    template <typename T>
    bool operator()(const T *log_alpha, const T *f0, const T *kd, T *residuals) const {
        using std::exp;
        const T shape = lobe<T>(kind, o.at, exp(*log_alpha));
        for (std::size_t c = 0; c < 3; ++c) residuals[c] = o.weight * (value<T>(shape, o.rise, f0[c], kd[c]) - o.f[c]);
        return true;
    }
};

// Sum over the observations of measure(square of the three channels' residuals, the loss's squared scale).
template <typename Measure>
double sum_of(const std::vector<Observation> &all, Baseline kind, const BaselineFit &fit, Measure measure) {
    double sum = 0.0;
    for (const Observation &o : all) {
        const double shape = lobe(kind, o.at, fit.alpha);
        double square = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double r = o.weight * (value(shape, o.rise, fit.f0[c], fit.kd[c]) - o.f[c]);
            square += r * r;
        }
        sum += measure(square, o.loss_scale * o.loss_scale);
    }
    return sum;
}

// Twice the cost that Ceres minimises.
double robust_cost(const std::vector<Observation> &all, Baseline kind, const BaselineFit &fit) {
    return sum_of(all, kind, fit, [](double square, double scale2) { return scale2 * std::log1p(square / scale2); });
}

// The colours at this alpha, for a start: for each channel, least squares in f0 and kd with both at or above 0. Only
// where Schlick's curve has not risen yet: towards grazing it is 1 whatever f0 is, and a sharp lobe on a table without
// that rise is off by so much that nothing else would count.
void solve_colours(const std::vector<Observation> &all, Baseline kind, BaselineFit &fit) {
    for (std::size_t c = 0; c < 3; ++c) {
        // Normal equations of f - rise lobe = f0 (1 - rise) lobe + kd / pi.
        double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0;
        for (const Observation &o : all) {
            if (o.rise > max_start_rise) continue;
            const double shape = lobe(kind, o.at, fit.alpha), w2 = o.weight * o.weight;
            const double a = (1.0 - o.rise) * shape, b = std::numbers::inv_pi, y = o.f[c] - o.rise * shape;
            aa += w2 * a * a;
            ab += w2 * a * b;
            bb += w2 * b * b;
            ay += w2 * a * y;
            by += w2 * b * y;
        }
        const double determinant = aa * bb - ab * ab;
        fit.f0[c] = aa > 0.0 ? std::max(ay / aa, 0.0) : 0.0;
        fit.kd[c] = 0.0;
        if (kind != Baseline::GgxLambert || !(determinant > 1e-12 * aa * bb)) continue;
        const double f0 = (ay * bb - by * ab) / determinant, kd = (by * aa - ay * ab) / determinant;
        if (kd <= 0.0) continue; // the one-parameter optimum above
        fit.f0[c] = std::max(f0, 0.0);
        fit.kd[c] = f0 > 0.0 ? kd : std::max(by / bb, 0.0);
    }
}

// The best starts, best first.
std::vector<BaselineFit> best_starts(const std::vector<Observation> &all, Baseline kind) {
    std::vector<std::pair<double, BaselineFit>> list; // with their costs
    for (double alpha : start_alphas) {
        BaselineFit fit;
        fit.alpha = alpha;
        solve_colours(all, kind, fit);
        list.emplace_back(robust_cost(all, kind, fit), fit);
    }
    std::sort(list.begin(), list.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<BaselineFit> best;
    for (std::size_t k = 0; k < starts; ++k) best.push_back(list[k].second);
    return best;
}

// Refines the fit in place; returns its cost, infinite where the solver fails.
double refine(const std::vector<Observation> &all, Baseline kind, BaselineFit &fit) {
    double log_alpha = std::log(fit.alpha);
    ceres::Problem problem;
    for (const Observation &o : all) {
        auto *cost = new ceres::AutoDiffCostFunction<Residual, 3, 1, 3, 3>(new Residual{o, kind});
        problem.AddResidualBlock(cost, new ceres::CauchyLoss(o.loss_scale), &log_alpha, fit.f0.data(), fit.kd.data());
    }
    problem.SetParameterLowerBound(&log_alpha, 0, std::log(min_alpha));
    problem.SetParameterUpperBound(&log_alpha, 0, std::log(max_alpha));
    for (int c = 0; c < 3; ++c) {
        problem.SetParameterLowerBound(fit.f0.data(), c, 0.0);
        problem.SetParameterLowerBound(fit.kd.data(), c, 0.0);
    }
    if (kind != Baseline::GgxLambert) problem.SetParameterBlockConstant(fit.kd.data());

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 30;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    fit.alpha = std::exp(log_alpha);
    fit.iterations = static_cast<unsigned>(summary.num_successful_steps);
    fit.message = summary.message;
    return summary.IsSolutionUsable() ? summary.final_cost : HUGE_VAL;
}

} // namespace

BaselineFit fit_baseline(const Brdf &brdf, Baseline kind) {
    require(kind == Baseline::Beckmann || kind == Baseline::Ggx || kind == Baseline::GgxLambert, "kind is ",
            static_cast<int>(kind), "; it must be 0 (Beckmann), 1 (GGX) or 2 (GGX and Lambert)");
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Observation> all = observations(brdf);
    if (all.empty())
        fail(Fault::NoSolution, brdf.name(), ": nothing is reflected in a measured cell above the horizon");

    std::vector<BaselineFit> fits = best_starts(all, kind);
    std::array<double, starts> costs{};
    for (std::size_t k = 0; k < starts; ++k) costs[k] = refine(all, kind, fits[k]);
    const auto best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    if (!std::isfinite(costs[best])) fail(Fault::NoSolution, brdf.name(), ": no start converged: ", fits[best].message);

    BaselineFit fit = fits[best];
    double value2 = 0.0;
    for (const Observation &o : all)
        for (double f : o.f) value2 += o.weight * o.weight * f * f;
    fit.residual = std::sqrt(sum_of(all, kind, fit, [](double square, double) { return square; }) / value2);
    fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fit.errors = brdf_errors(
        [&](std::size_t, std::size_t, const Cosines &at) {
            const double shape = lobe(kind, at, fit.alpha), rise = schlick_rise(at.d);
            return Rgb{value(shape, rise, fit.f0[0], fit.kd[0]), value(shape, rise, fit.f0[1], fit.kd[1]),
                       value(shape, rise, fit.f0[2], fit.kd[2])};
        },
        brdf);
    return fit;
}

} // namespace smx
