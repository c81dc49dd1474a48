// Mixtures of known lobes come back, judged by likelihood and distance, never by the order of their lobes.
#include <gtest/gtest.h>

#include "close.h"
#include "support.h"

using oracle::Lobe;
using oracle::Masking;

namespace {

// The density comes from a table with finite cells, so even the true mixture is not its best explanation: how far the
// fit may stay below the truth in mean log likelihood, and how far above it can be without having fitted something
// else.
constexpr double likelihood_below = 1e-3;
constexpr double likelihood_above = 2e-2;
// Hellinger distance of a fit with as many lobes as the truth, from the same cells (measured 0.01).
constexpr double residual_limit = 0.03;
// EM stops when an iteration gains less than 1e-10; with surplus lobes it creeps, and may stop this far below the
// optimum.
constexpr double stopping_tolerance = 1e-4;
// The report's likelihood against the same sum made here from the nodes.
constexpr double report_tolerance = 1e-6;

struct Fitted {
    smx_density density = nullptr;
    test::Material material;
    smx_fit_report report = SMX_FIT_REPORT_INIT;
};

const std::vector<std::vector<Lobe>> &known_mixtures() {
    static const std::vector<std::vector<Lobe>> list{
        {{0.6, 0.03}, {0.4, 0.3}},
        {{0.2, 0.1}, {0.8, 0.4}},
        {{0.3, 0.02}, {0.4, 0.1}, {0.3, 0.5}},
    };
    return list;
}

// Of the table that a known mixture makes.
smx_density density_of(std::size_t mixture) {
    static std::array<test::Density, 3> densities;
    if (!densities[mixture].get()) {
        const oracle::Table table = test::beckmann_table(known_mixtures()[mixture], Masking::correlated);
        densities[mixture] = test::make_density(test::make_brdf(table), SMX_MASKING_CORRELATED);
    }
    return densities[mixture];
}

Fitted fit_table(std::size_t mixture, uint32_t count) {
    Fitted f;
    f.density = density_of(mixture);
    f.material = test::fit(f.density, count);
    EXPECT_SMX_OK(smx_material_get_report(f.material, &f.report));
    return f;
}

std::vector<Lobe> as_oracle(const std::vector<smx_lobe> &lobes) {
    std::vector<Lobe> result;
    for (const smx_lobe &l : lobes) result.push_back({l.weight, l.alpha});
    return result;
}

// Mean log density of a mixture under the slope density's masses. Far tails underflow, hence logarithms per lobe.
double log_likelihood(smx_density density, const std::vector<Lobe> &lobes) {
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    EXPECT_SMX_OK(smx_density_get_info(density, &info));
    std::vector<double> slope(info.nodes), mass(info.nodes);
    EXPECT_SMX_OK(smx_density_get_nodes(density, slope.data(), nullptr, mass.data(), info.nodes));
    double sum = 0.0;
    for (std::size_t j = 0; j < slope.size(); ++j) {
        if (mass[j] <= 0.0) continue;
        double largest = -HUGE_VAL, total = 0.0;
        const auto log_density = [&](const Lobe &l) {
            return std::log(l.weight) - slope[j] * slope[j] / (l.alpha * l.alpha) -
                   std::log(oracle::pi * l.alpha * l.alpha);
        };
        for (const Lobe &l : lobes) largest = std::max(largest, log_density(l));
        for (const Lobe &l : lobes) total += std::exp(log_density(l) - largest);
        sum += mass[j] * (largest + std::log(total));
    }
    return sum;
}

} // namespace

TEST(Fit, KnownMixturesAreRecoveredInLikelihood) {
    for (std::size_t k = 0; k < known_mixtures().size(); ++k) {
        const std::vector<Lobe> &truth = known_mixtures()[k];
        const Fitted f = fit_table(k, static_cast<uint32_t>(truth.size()));
        const double fitted = log_likelihood(f.density, as_oracle(test::lobes_of(f.material)));
        const double wanted = log_likelihood(f.density, truth);
        EXPECT_GT(fitted, wanted - likelihood_below) << "lobe 0: weight " << truth[0].weight;
        EXPECT_LT(fitted, wanted + likelihood_above) << "lobe 0: weight " << truth[0].weight;
        EXPECT_LT(f.report.residual, residual_limit);
        // The measure tells a wrong mixture from the right one.
        std::vector<Lobe> wrong = truth;
        std::swap(wrong.front().weight, wrong.back().weight);
        wrong.back().alpha *= 1.2;
        EXPECT_LT(log_likelihood(f.density, wrong), wanted - 5.0 * likelihood_below);
    }
}

TEST(Fit, ReportedLikelihoodIsThatOfTheLobes) {
    const Fitted f = fit_table(0, 2);
    const double here = log_likelihood(f.density, as_oracle(test::lobes_of(f.material)));
    EXPECT_CLOSE(f.report.log_likelihood, here, report_tolerance, report_tolerance);
}

TEST(Fit, MoreLobesExplainNoWorse) {
    const Fitted one = fit_table(2, 1);
    double before = one.report.log_likelihood_em;
    for (const uint32_t count : {2u, 4u, 8u, 16u}) {
        smx_fit_report report = SMX_FIT_REPORT_INIT;
        ASSERT_SMX_OK(smx_material_get_report(test::fit(one.density, count), &report));
        EXPECT_GE(report.log_likelihood_em, before - stopping_tolerance) << count << " lobes";
        before = report.log_likelihood_em;
    }
}

TEST(Fit, RefinementComesNoFurtherFromTheDensity) {
    for (std::size_t k = 0; k < known_mixtures().size(); ++k) {
        const smx_fit_report report = fit_table(k, 8).report;
        EXPECT_LE(report.residual, report.residual_em * (1.0 + 1e-9));
        EXPECT_GT(report.em_iterations, 0u);
        EXPECT_STRNE(report.refine_message, "");
    }
}

TEST(Fit, WithoutRefinementTheReportSaysSo) {
    const Fitted f = fit_table(0, 2);
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.model = SMX_MODEL_SHARED;
    options.lobes = 2;
    options.refine = 0;
    test::Material material;
    ASSERT_SMX_OK(smx_material_fit(f.density, &options, material.out()));
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    ASSERT_SMX_OK(smx_material_get_report(material, &report));
    EXPECT_EQ(report.refine_iterations, 0u);
    EXPECT_STREQ(report.refine_message, "");
    EXPECT_EQ(report.residual, report.residual_em);
    EXPECT_EQ(report.log_likelihood, report.log_likelihood_em);
}

TEST(Fit, LobesAreAMixtureInAscendingAlpha) {
    for (const uint32_t count : {1u, 3u, 8u, 64u}) {
        const Fitted f = fit_table(1, count);
        const std::vector<smx_lobe> lobes = test::lobes_of(f.material);
        ASSERT_GE(lobes.size(), 1u);
        EXPECT_LE(lobes.size(), count);
        EXPECT_EQ(lobes.size(), f.report.lobes);
        double sum = 0.0;
        for (std::size_t k = 0; k < lobes.size(); ++k) {
            EXPECT_GT(lobes[k].weight, 0.0);
            EXPECT_GE(lobes[k].alpha, k == 0 ? 1e-4 : lobes[k - 1].alpha);
            EXPECT_LE(lobes[k].alpha, 1e4);
            sum += lobes[k].weight;
        }
        EXPECT_CLOSE(sum, 1.0, 1e-12, 0.0);
    }
}

TEST(Fit, SameInputSameBits) {
    const Fitted a = fit_table(0, 8), b = fit_table(0, 8);
    const std::vector<smx_lobe> x = test::lobes_of(a.material), y = test::lobes_of(b.material);
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
        EXPECT_EQ(x[k].weight, y[k].weight);
        EXPECT_EQ(x[k].alpha, y[k].alpha);
    }
}
