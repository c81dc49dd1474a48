#include "baseline.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "ceres_solver.h"
#include "error.h"
#include "material.h"
#include "microfacet.h"

namespace smx {

namespace {

constexpr std::array start_alphas = {0.002, 0.006, 0.02, 0.06, 0.2, 0.6};
constexpr std::size_t starts = 2; // of them, the best
constexpr std::size_t theta_d_step = 4, phi_d_samples = 6;

// One cell of the table, as the baselines see it.
struct Observation {
    Cosines at;
    double rise; // Schlick's, of theta_d
    double cos_i;
    Rgb f;
    double weight; // of the difference
};

// A share of the cells that the log error is over (brdf_errors.h), with its weights: every theta_h,
// since lobes are sharp there; phi_d at nodes that shift from one theta_h to the next; each order of the directions in
// turn.
std::vector<Observation> observations(const Brdf &brdf) {
    std::vector<Observation> all;
    const std::size_t columns = brdf.phi_d_count();
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t d = 0; d < Brdf::theta_d_count; d += theta_d_step)
            for (std::size_t j = 0; j < phi_d_samples; ++j) {
                const std::size_t p = (j * (columns / phi_d_samples) + 7 * h) % columns, cell = brdf.cell(h, d, p);
                const Cosines at = Brdf::cosines(h, d, p);
                if (at.i <= 0.0 || at.o <= 0.0 || !brdf.valid(cell)) continue;
                const double measure = Brdf::theta_h_weight(h) * std::sin(2 * Brdf::theta_d(d));
                all.push_back({at,
                               schlick_rise(at.d),
                               (h + d + j) % 2 ? at.o : at.i,
                               {brdf.value(0, cell), brdf.value(1, cell), brdf.value(2, cell)},
                               std::sqrt(measure)});
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

// f of channel c, given the lobe's value.
double value(double lobe, double rise, std::size_t c, const BaselineFit &fit) {
    return (fit.f0[c] + (fit.f90[c] - fit.f0[c]) * rise) * lobe + fit.kd[c] / std::numbers::pi;
}

// The difference that is squared.
double log_difference(const Observation &o, double f, double r) {
    return o.weight * (std::log1p(f * o.cos_i) - std::log1p(r * o.cos_i));
}

// One observation for Ceres: the derivative by log alpha is automatic, those by the colours are plain.
class LogDifference : public ceres::SizedCostFunction<3, 1, 3, 3, 3> {
  public:
    LogDifference(const Observation &o, Baseline kind) : o_(o), kind_(kind) {}

    bool Evaluate(const double *const *parameters, double *residuals, double **jacobians) const override {
        using Jet = ceres::Jet<double, 1>;
        const double *f0 = parameters[1], *f90 = parameters[2], *kd = parameters[3];
        const Jet shape = lobe<Jet>(kind_, o_.at, exp(Jet(*parameters[0], 0)));
        for (std::size_t c = 0; c < 3; ++c) {
            const double fresnel = f0[c] + (f90[c] - f0[c]) * o_.rise;
            const double f = fresnel * shape.a + kd[c] * std::numbers::inv_pi;
            residuals[c] = log_difference(o_, f, o_.f[c]);
            if (!jacobians) continue;
            const double by_f = o_.weight * o_.cos_i / (1.0 + f * o_.cos_i);
            if (jacobians[0]) jacobians[0][c] = by_f * fresnel * shape.v[0];
            set_row(jacobians[1], c, by_f * (1.0 - o_.rise) * shape.a);
            set_row(jacobians[2], c, by_f * o_.rise * shape.a);
            set_row(jacobians[3], c, by_f * std::numbers::inv_pi);
        }
        return true;
    }

  private:
    // Row c of a colour's derivatives: a channel depends on its own alone.
    static void set_row(double *jacobian, std::size_t c, double derivative) {
        if (!jacobian) return;
        for (std::size_t k = 0; k < 3; ++k) jacobian[3 * c + k] = k == c ? derivative : 0.0;
    }

    const Observation &o_;
    Baseline kind_;
};

// Sum of squares over the observations.
double cost_of(const std::vector<Observation> &all, Baseline kind, const BaselineFit &fit) {
    double sum = 0.0;
    for (const Observation &o : all) {
        const double shape = lobe(kind, o.at, fit.alpha);
        for (std::size_t c = 0; c < 3; ++c) sum += std::pow(log_difference(o, value(shape, o.rise, c, fit), o.f[c]), 2);
    }
    return sum;
}

// The colours at this alpha, for a start, with f90 = f0: for each channel, least squares in f0 and kd with both at or
// above 0, of the differences to first order, (f - r) cos_i / (1 + r cos_i).
void solve_colours(const std::vector<Observation> &all, Baseline kind, BaselineFit &fit) {
    for (std::size_t c = 0; c < 3; ++c) {
        // Normal equations of f = f0 lobe + kd / pi.
        double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0;
        for (const Observation &o : all) {
            const double scale = o.weight * o.cos_i / (1.0 + o.f[c] * o.cos_i);
            const double a = scale * lobe(kind, o.at, fit.alpha), b = scale * std::numbers::inv_pi, y = scale * o.f[c];
            aa += a * a;
            ab += a * b;
            bb += b * b;
            ay += a * y;
            by += b * y;
        }
        const double determinant = aa * bb - ab * ab;
        fit.f0[c] = aa > 0.0 ? std::max(ay / aa, 0.0) : 0.0;
        fit.kd[c] = 0.0;
        if (kind == Baseline::GgxLambert && determinant > 1e-12 * aa * bb) {
            const double f0 = (ay * bb - by * ab) / determinant, kd = (by * aa - ay * ab) / determinant;
            if (kd > 0.0) { // else the optimum with kd = 0, above
                fit.f0[c] = std::max(f0, 0.0);
                fit.kd[c] = f0 > 0.0 ? kd : std::max(by / bb, 0.0);
            }
        }
        fit.f90[c] = fit.f0[c];
    }
}

// The best starts, best first.
std::vector<BaselineFit> best_starts(const std::vector<Observation> &all, Baseline kind) {
    std::vector<std::pair<double, BaselineFit>> list; // with their costs
    for (double alpha : start_alphas) {
        BaselineFit fit;
        fit.alpha = alpha;
        solve_colours(all, kind, fit);
        list.emplace_back(cost_of(all, kind, fit), fit);
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
    for (const Observation &o : all)
        problem.AddResidualBlock(new LogDifference(o, kind), nullptr, &log_alpha, fit.f0.data(), fit.f90.data(),
                                 fit.kd.data());
    problem.SetParameterLowerBound(&log_alpha, 0, std::log(min_alpha));
    problem.SetParameterUpperBound(&log_alpha, 0, std::log(max_alpha));
    for (int c = 0; c < 3; ++c) {
        for (Rgb *colour : {&fit.f0, &fit.f90, &fit.kd}) problem.SetParameterLowerBound(colour->data(), c, 0.0);
    }
    if (kind != Baseline::GgxLambert) problem.SetParameterBlockConstant(fit.kd.data());

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 50;
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
    double size = 0.0; // of what is fitted
    for (const Observation &o : all)
        for (double r : o.f) size += std::pow(log_difference(o, 0.0, r), 2);
    if (size == 0.0)
        fail(Fault::NoSolution, brdf.name(), ": nothing is reflected in a measured cell above the horizon");

    std::vector<BaselineFit> fits = best_starts(all, kind);
    std::array<double, starts> costs{};
    for (std::size_t k = 0; k < starts; ++k) costs[k] = refine(all, kind, fits[k]);
    const auto best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    if (!std::isfinite(costs[best])) fail(Fault::NoSolution, brdf.name(), ": no start converged: ", fits[best].message);

    BaselineFit fit = fits[best];
    fit.residual = std::sqrt(cost_of(all, kind, fit) / size);
    fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fit.errors = brdf_errors(
        [&](std::size_t, std::size_t, const Cosines &at) {
            const double shape = lobe(kind, at, fit.alpha), rise = schlick_rise(at.d);
            return Rgb{value(shape, rise, 0, fit), value(shape, rise, 1, fit), value(shape, rise, 2, fit)};
        },
        brdf);
    return fit;
}

} // namespace smx
