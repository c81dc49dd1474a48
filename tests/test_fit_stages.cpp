// The fit's stages by themselves, below the C API: EM's climb, and the derivatives that Ceres is given.
#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "analytic.h"
#include "compressed_levels.h"
#include "em.h"
#include "em_starts.h"
#include "fit_data.h"
#include "fit_per_lobe.h"
#include "lobe_curves.h"
#include "lobe_value.h"
#include "per_lobe_problem.h"
#include "refine_per_lobe.h"

namespace {

using namespace smx;

// A step of EM may lose roundings, and lobes of less than 1e-14 of the mass.
constexpr double allowed_fall = 1e-12;

// Ridders' differences from a step of 1e-4, where a lobe's exponent, up to 50, is nearly linear: good to about 1e-6.
constexpr double gradient_tolerance = 1e-4;

ceres::NumericDiffOptions difference_options() {
    ceres::NumericDiffOptions options;
    options.ridders_relative_initial_step_size = 1e-4;
    return options;
}

// The compressed residuals against the samples themselves: roundings of a QR factorisation.
constexpr double compression_tolerance = 1e-12;

constexpr const std::vector<const ceres::Manifold *> *no_manifolds = nullptr;

const Brdf &table() {
    static const Brdf brdf = make_analytic("ggx,alpha=0.2,f0=0.9/0.5/0.1");
    return brdf;
}

const FitData &data() {
    static const FitData made(table());
    return made;
}

// A density of a heavy tail, on nodes as uneven as the inversion's.
SlopeDensity heavy_tail() {
    SlopeDensity density;
    for (int j = 0; j < 90; ++j) {
        const double u = (j + 0.3) / 90, slope = std::tan(u * u * 1.57), s = slope * slope;
        density.slope.push_back(slope);
        density.p22.push_back(0.09 / (std::numbers::pi * std::pow(0.09 + s, 2)));
        density.area.push_back(2 * std::numbers::pi * slope * (1 + s) * 3.14 * u / 90);
        density.mass.push_back(density.p22.back() * density.area.back());
    }
    const double total = std::accumulate(density.mass.begin(), density.mass.end(), 0.0);
    for (double &mass : density.mass) mass /= total;
    return density;
}

PerLobeFit start(std::vector<double> alphas = {0.07, 0.2, 0.6}) {
    PerLobeFit fit{std::move(alphas), {}};
    fit.curves = fit_curves(data().base, fit.alphas);
    for (CurveCoefficients &curves : fit.curves) // away from the bounds, where a difference would step over them
        for (std::vector<double> &channel : curves)
            for (double &value : channel) value += 0.05;
    return fit;
}

// lobe_value as a function of log alpha.
class LobeCost : public ceres::SizedCostFunction<1, 1> {
  public:
    explicit LobeCost(const DirectionSample &sample) : sample_(sample) {}
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        const LobeValue lobe = lobe_value(sample_, std::exp(p[0][0]));
        residuals[0] = lobe.value;
        if (jacobians && jacobians[0]) jacobians[0][0] = lobe.derivative;
        return true;
    }

  private:
    DirectionSample sample_;
};

// The whole problem's cost as a function of all its blocks. (Residuals stand in a basis that turns with the alphas; the
// cost and its gradient do not.)
class WholeCost : public ceres::CostFunction {
  public:
    explicit WholeCost(ceres::Problem &problem) : problem_(problem) {
        problem.GetParameterBlocks(&blocks_);
        for (double *block : blocks_) mutable_parameter_block_sizes()->push_back(problem.ParameterBlockSize(block));
        set_num_residuals(1);
    }
    std::vector<double *> blocks() const { return blocks_; }
    bool Evaluate(double const *const *p, double *residuals, double **jacobians) const override {
        for (std::size_t b = 0; b < blocks_.size(); ++b) std::copy_n(p[b], parameter_block_sizes()[b], blocks_[b]);
        std::vector<double> gradient;
        ceres::Problem::EvaluateOptions order;
        order.parameter_blocks = blocks_;
        problem_.Evaluate(order, residuals, nullptr, jacobians ? &gradient : nullptr, nullptr);
        const double *at = gradient.data();
        for (std::size_t b = 0; jacobians && b < blocks_.size(); at += parameter_block_sizes()[b++])
            if (jacobians[b]) std::copy_n(at, parameter_block_sizes()[b], jacobians[b]);
        return true;
    }

  private:
    ceres::Problem &problem_;
    std::vector<double *> blocks_;
};

// Half the sum of squares over the samples themselves, without the curves' roughness.
double plain_cost(const std::vector<DirectionLevel> &levels, const PerLobeFit &fit) {
    double sum = 0.0;
    for (const DirectionLevel &level : levels)
        for (const DirectionSample &s : level.samples) {
            const Rgb model = value_at(fit, curve_shares(level.theta_d), s);
            for (std::size_t c = 0; c < 3; ++c) sum += std::pow(s.weight * (model[c] - s.f[c]), 2);
        }
    return sum / 2;
}

} // namespace

TEST(FitStages, LikelihoodNeverFallsFromAnyStart) {
    const SlopeDensity density = heavy_tail();
    for (const unsigned lobes : {1u, 2u, 3u, 5u, 8u, 16u, 33u, 64u}) {
        const EmResult result = fit_em(density, lobes, 1e-9, 2000);
        EXPECT_LE(result.largest_fall, allowed_fall) << lobes;
        EXPECT_NEAR(result.log_likelihood, mean_log_likelihood(result.lobes, density), 1e-12) << lobes;
        EXPECT_LE(result.lobes.size(), lobes);
        double weight = 0.0, before = 0.0;
        for (const Lobe &lobe : result.lobes) {
            EXPECT_GT(lobe.weight, 0.0) << lobes;
            EXPECT_GE(lobe.alpha, before) << lobes;
            before = lobe.alpha;
            weight += lobe.weight;
        }
        EXPECT_NEAR(weight, 1.0, 1e-12) << lobes;
    }
}

TEST(FitStages, TheBestStartIsNoWorseThanEach) {
    const SlopeDensity density = heavy_tail();
    for (const unsigned lobes : {2u, 4u, 8u}) {
        const double best = fit_em(density, lobes, 1e-9, 50).log_likelihood;
        double lowest = best;
        for (const std::vector<Lobe> &start :
             {quantile_start(density, lobes), cluster_start(density, lobes, 1), cluster_start(density, lobes, 2)}) {
            const double climbed = climb(start, density, 1e-9, 50).log_likelihood;
            EXPECT_GE(best, climbed - allowed_fall) << lobes;
            lowest = std::min(lowest, climbed);
        }
        EXPECT_LT(lowest, best) << lobes; // it makes a difference
    }
}

TEST(FitStages, ClustersSeeANarrowLobeOfLittleMass) {
    SlopeDensity density = heavy_tail();
    double narrow = 1.0;
    for (const Lobe &lobe : cluster_start(density, 8, 1)) narrow = std::min(narrow, lobe.alpha);
    EXPECT_LT(narrow, quantile_start(density, 8).front().alpha / 2);
}

TEST(FitStages, LobesHaveTheirDerivative) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int checked = 0;
    for (int k = 0; k < 4000; ++k) {
        DirectionSample sample =
            direction_at(std::pow(unit(random), 2) * 1.5, unit(random) * 1.5, unit(random) * std::numbers::pi);
        if (sample.ci < 0.02 || sample.co < 0.02) continue;
        if (k % 3 == 0) sample.displacement2 = std::pow(unit(random), 2);
        double log_alpha = std::log(1e-3) + unit(random) * std::log(2e4);
        const LobeCost cost(sample);
        if (lobe_value(sample, std::exp(log_alpha)).value < 1e-12) continue; // too small for a relative difference
        double *blocks[] = {&log_alpha};
        ceres::GradientChecker checker(&cost, no_manifolds, difference_options());
        ceres::GradientChecker::ProbeResults results;
        EXPECT_TRUE(checker.Probe(blocks, gradient_tolerance, &results))
            << "alpha " << std::exp(log_alpha) << " tan2 " << sample.tan2 << ": " << results.error_log;
        ++checked;
    }
    EXPECT_GT(checked, 1000);
}

TEST(FitStages, TheWholeProblemHasItsGradient) {
    const std::vector<DirectionLevel> levels = joined(data().base, data().displaced, 0.1);
    PerLobeProblem problem(levels, start());
    const WholeCost cost(problem.problem());
    ceres::GradientChecker checker(&cost, no_manifolds, difference_options());
    ceres::GradientChecker::ProbeResults results;
    std::vector<std::vector<double>> values;
    std::vector<double *> pointers;
    for (std::size_t b = 0; b < cost.blocks().size(); ++b)
        values.emplace_back(cost.blocks()[b], cost.blocks()[b] + cost.parameter_block_sizes()[b]);
    for (std::vector<double> &block : values) pointers.push_back(block.data());
    EXPECT_TRUE(checker.Probe(pointers.data(), gradient_tolerance, &results)) << results.error_log;
}

TEST(FitStages, TheEnergyBoundHasItsGradient) {
    const PerLobeFit fit = start({1.0, 3.0, 8.0}); // wide: every coefficient is seen from everywhere
    std::vector<EnergyBound> energy;
    for (const Eigen::MatrixXd &shares : data().albedo.shares(fit.alphas)) energy.push_back({shares, {0.3, 1e6, 0.1}});
    PerLobeProblem problem(data().base, fit, energy);
    std::vector<ceres::ResidualBlockId> blocks;
    problem.problem().GetResidualBlocks(&blocks);
    int checked = 0, above = 0;
    for (const ceres::ResidualBlockId &block : blocks) {
        const ceres::CostFunction *function = problem.problem().GetCostFunctionForResidualBlock(block);
        if (function->num_residuals() != 1) continue; // the energy's
        std::vector<double *> parameters;
        problem.problem().GetParameterBlocksForResidualBlock(block, &parameters);
        ceres::GradientChecker checker(function, no_manifolds, difference_options());
        ceres::GradientChecker::ProbeResults results;
        checker.Probe(parameters.data(), gradient_tolerance, &results);
        double largest = 0.0, difference = 0.0; // some shares are 1e-9 of others, below the differences' roundings
        for (std::size_t b = 0; b < parameters.size(); ++b) {
            largest = std::max(largest, results.numeric_jacobians[b].cwiseAbs().maxCoeff());
            difference =
                std::max(difference, (results.jacobians[b] - results.numeric_jacobians[b]).cwiseAbs().maxCoeff());
        }
        EXPECT_LE(difference, gradient_tolerance * largest) << results.error_log;
        above += largest > 0.0;
        ++checked;
    }
    EXPECT_EQ(checked, static_cast<int>(3 * DirectionalAlbedo::theta_o_degrees.size()));
    EXPECT_GT(above, 0); // beyond their bound
}

TEST(FitStages, EnergyIsBroughtWithinItsBound) {
    PerLobeRefinement result{start(), 0, {}};
    const std::vector<Rgb> bound = data().albedo_bound();
    const auto excess = [&] {
        double most = -HUGE_VAL;
        const auto shares = data().albedo.shares(result.fit.alphas);
        for (std::size_t t = 0; t < shares.size(); ++t)
            for (std::size_t c = 0; c < 3; ++c) {
                double albedo = 0.0;
                for (Eigen::Index k = 0; k < shares[t].cols(); ++k)
                    for (Eigen::Index j = 0; j < shares[t].rows(); ++j)
                        albedo += shares[t](j, k) *
                                  result.fit.curves[static_cast<std::size_t>(k)][c][static_cast<std::size_t>(j)];
                most = std::max(most, albedo / bound[t][c] - 1.0);
            }
        return most;
    };
    for (CurveCoefficients &curves : result.fit.curves)
        for (std::vector<double> &channel : curves)
            for (double &value : channel) value *= 2.0;
    EXPECT_GT(excess(), 0.1);
    bound_energy(data().base, data().albedo, bound, 6, result);
    EXPECT_LE(excess(), 1e-12);
    EXPECT_GT(excess(), -0.5); // it did not go black
}

TEST(FitStages, SpreadAlphasLieBetweenTheMixturesEnds) {
    const std::vector<double> alphas = spread_alphas({{0.5, 0.01}, {0.3, 0.02}, {0.2, 1.0}});
    ASSERT_EQ(alphas.size(), 3u);
    EXPECT_GT(alphas[0], 0.01);
    EXPECT_LT(alphas[2], 1.0);
    EXPECT_NEAR(alphas[1] / alphas[0], alphas[2] / alphas[1], 1e-12);
    EXPECT_NEAR(alphas[1], 0.1, 1e-12);
}

TEST(FitStages, CompressedResidualsHaveTheSamplesSumOfSquares) {
    const PerLobeFit fit = start();
    CompressedLevels compressed(data().base);
    std::vector<double> log_alphas;
    for (double alpha : fit.alphas) log_alphas.push_back(std::log(alpha));
    compressed.update(log_alphas);
    double sum = 0.0;
    for (std::size_t l = 0; l < compressed.size(); ++l) {
        const auto [first, weight] = curve_shares(compressed.theta_d(l));
        for (std::size_t c = 0; c < 3; ++c) {
            Eigen::VectorXd r = -compressed.data(l, c);
            for (std::size_t k = 0; k < fit.alphas.size(); ++k)
                for (std::size_t a = 0; a < 3; ++a)
                    r += weight[a] * fit.curves[k][c][first + a] * compressed.lobe(l, static_cast<Eigen::Index>(k));
            sum += r.squaredNorm();
        }
    }
    const double plain = plain_cost(data().base, fit);
    EXPECT_NEAR(sum / 2, plain, compression_tolerance * plain);
}
