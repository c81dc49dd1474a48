// Slope densities that try to break EM and its refinement: one node, two far apart, masses from 1e-300, more lobes than
// nodes. The mixture is finite and normalised, its likelihood never falls and is no worse than one lobe's, and neither
// the order of what is given nor a table's scale matters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "density_nodes.h"
#include "em.h"
#include "error.h"
#include "fit_mixture.h"
#include "random.h"
#include "refine.h"
#include "slope_density.h"
#include "support.h"

namespace {

using namespace smx;

constexpr std::size_t nodes = DensityNodes::count;
constexpr std::size_t cells = std::size_t{90} * 90 * 180; // of a table's channel

// A step of EM may lose roundings, and lobes of less than 1e-14 of the mass.
constexpr double allowed_fall = 1e-12;
// What a thousand steps of EM may leave.
constexpr double unconverged = 1e-6;
// The refinement and the joining of lobes may each give up this much of the likelihood, in nat, per lobe.
constexpr double allowed_loss = 1e-8;
// Of the likelihood of the truth, what a fit with lobes to spare may fall short by; relative.
constexpr double likelihood_tolerance = 1e-6;
// Two fits to what is the same but for the order of its sums; relative.
constexpr double order_tolerance = 1e-6;

struct Case {
    std::string name;
    std::vector<double> ndf;
};

SlopeDensity density_of(std::vector<double> ndf) {
    const DensityNodes n;
    SlopeDensity density;
    density.mass = n.normalise(ndf);
    n.store(ndf, density);
    for (std::vector<double> &curve : density.fresnel) curve.assign(91, 1.0);
    return density;
}

std::vector<double> spikes(const std::vector<std::size_t> &at) {
    std::vector<double> ndf(nodes, 0.0);
    for (const std::size_t node : at) ndf[node] = 1.0;
    return ndf;
}

std::vector<double> formula(const std::function<double(std::size_t)> &of) {
    std::vector<double> ndf;
    for (std::size_t j = 0; j < nodes; ++j) ndf.push_back(of(j));
    return ndf;
}

std::vector<Case> cases() {
    test::Random random(29);
    return {
        {"the pole alone", spikes({0})},
        {"the second node alone", spikes({1})},
        {"one in the middle", spikes({45})},
        {"the horizon's node alone", spikes({89})},
        {"both ends", spikes({0, 89})},
        {"three nodes", spikes({3, 4, 70})},
        {"flat", formula([](std::size_t) { return 1.0; })},
        {"a cliff", formula([](std::size_t j) { return std::exp(-10.0 * static_cast<double>(j)); })},
        {"growing to the horizon", formula([](std::size_t j) { return std::exp(static_cast<double>(j)); })},
        {"random over 300 decades", formula([&](std::size_t) { return random.log_uniform(1e-300, 1.0); })},
        {"every other node", formula([](std::size_t j) { return j % 2 ? 0.0 : 1.0 / static_cast<double>(j + 1); })},
    };
}

std::size_t nodes_with_mass(const SlopeDensity &density) {
    return static_cast<std::size_t>(
        std::count_if(density.mass.begin(), density.mass.end(), [](double mass) { return mass > 0.0; }));
}

void expect_mixture(const std::vector<Lobe> &lobes, std::size_t most) {
    EXPECT_GE(lobes.size(), 1u);
    EXPECT_LE(lobes.size(), most);
    double sum = 0.0, before = 0.0;
    for (const Lobe &lobe : lobes) {
        EXPECT_TRUE(std::isfinite(lobe.weight) && lobe.weight > 0.0) << lobe.weight;
        EXPECT_TRUE(lobe.alpha >= min_alpha && lobe.alpha <= max_alpha && lobe.alpha >= before) << lobe.alpha;
        before = lobe.alpha;
        sum += lobe.weight;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
}

double one_lobe_likelihood(const SlopeDensity &density) {
    return mean_log_likelihood({{1.0, std::clamp(density.alpha(), min_alpha, max_alpha)}}, density);
}

void expect_same(const std::vector<Lobe> &got, const std::vector<Lobe> &wanted) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t k = 0; k < got.size(); ++k) {
        EXPECT_NEAR(got[k].alpha, wanted[k].alpha, order_tolerance * wanted[k].alpha);
        EXPECT_NEAR(got[k].weight, wanted[k].weight, order_tolerance);
    }
}

// A material's lobes and curves from a table's values, [3][90][90][180].
test::Material fit_values(const std::vector<double> &values, smx_model model) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_brdf_create("hard", 180, values.data(), brdf.out()));
    return test::fit(test::make_density(brdf, SMX_MASKING_COINCIDES), 3, model);
}

std::vector<double> table_values(const char *name) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_brdf_open(name, brdf.out()));
    return test::filled_table(brdf).values;
}

std::vector<Lobe> mixture_of(smx_material material) {
    std::vector<Lobe> lobes;
    for (const smx_lobe &lobe : test::lobes_of(material)) lobes.push_back({lobe.weight, lobe.alpha});
    return lobes;
}

// A sound material from a table of `value` in these cells and 0 in the others; only of 1 must there be one.
void expect_sound_or_no_solution(std::size_t first, std::size_t count, double value, smx_model model) {
    std::vector<double> values(3 * cells);
    for (std::size_t c = 0; c < 3; ++c)
        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(c * cells + first), count, value);
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_create("spot", 180, values.data(), brdf.out()));
    test::Density density;
    smx_status status = smx_density_create(brdf, nullptr, density.out());
    test::Material material;
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.model = model;
    options.lobes = 3;
    if (status == SMX_OK) status = smx_material_fit(density, &options, material.out());
    if (status != SMX_OK) {
        EXPECT_EQ(status, SMX_NO_SOLUTION) << smx_last_error();
        EXPECT_NE(value, 1.0) << smx_last_error();
        return;
    }
    expect_mixture(mixture_of(material), 3);
    for (const double f : test::curves_of(material).fresnel) EXPECT_TRUE(std::isfinite(f) && f >= 0.0) << f;
}

} // namespace

TEST(FitHard, LikelihoodNeverFalls) {
    for (const Case &c : cases())
        for (const unsigned lobes : {1u, 2u, 8u, 16u, 64u}) {
            SCOPED_TRACE(c.name + ", " + std::to_string(lobes) + " lobes");
            const SlopeDensity density = density_of(c.ndf);
            const EmResult em = fit_em(density, lobes, 1e-8, 1000);
            expect_mixture(em.lobes, lobes);
            EXPECT_LE(em.largest_fall, allowed_fall);
            EXPECT_GE(em.log_likelihood, one_lobe_likelihood(density) - unconverged);
            EXPECT_TRUE(std::isfinite(em.log_likelihood));
        }
}

TEST(FitHard, RefinementNeverLoses) {
    for (const Case &c : cases())
        for (const unsigned lobes : {1u, 3u, 16u}) {
            SCOPED_TRACE(c.name + ", " + std::to_string(lobes) + " lobes");
            const SlopeDensity density = density_of(c.ndf);
            const Material fitted = fit_mixture(density, lobes, FitOptions{});
            expect_mixture(fitted.lobes, lobes);
            const FitReport &r = fitted.report;
            EXPECT_GE(r.log_likelihood, r.log_likelihood_em - lobes * allowed_loss);
            for (const double residual : {r.residual_em, r.residual})
                EXPECT_TRUE(std::isfinite(residual) && residual >= 0.0) << residual;
        }
}

// The likelihood of one slope is largest for alpha equal to it: its log is -1 - log(pi slope^2), and no mixture's more.
TEST(FitHard, OneSlopeIsOneLobe) {
    for (const std::size_t node : {0u, 1u, 45u, 89u})
        for (const unsigned lobes : {1u, 2u, 64u}) {
            const SlopeDensity density = density_of(spikes({node}));
            const double slope = density.slope[node];
            const Material fitted = fit_mixture(density, lobes, FitOptions{});
            ASSERT_EQ(fitted.lobes.size(), 1u) << "node " << node << ", " << lobes << " lobes";
            const double wanted = std::clamp(slope, min_alpha, max_alpha);
            EXPECT_NEAR(fitted.lobes[0].alpha, wanted, 1e-9 * wanted);
            EXPECT_NEAR(fitted.report.log_likelihood,
                        -slope * slope / (wanted * wanted) - std::log(oracle::pi * wanted * wanted), 1e-9);
        }
}

// Sixteen lobes for what is one: they find it, from a density's samples and from a table's inversion.
TEST(FitHard, SixteenLobesAreAsLikelyAsTheTrueOne) {
    test::Brdf table;
    ASSERT_SMX_OK(smx_brdf_open("analytic:beckmann,alpha=0.3,f0=0.9", table.out()));
    const std::vector<double> values = test::filled_table(table).values;
    std::vector<std::pair<double, SlopeDensity>> cases = {{0.3, invert(Brdf("beckmann", "", "", 180, values), {})}};
    for (const double alpha : {2e-3, 0.05, 0.3, 1.0, 10.0})
        cases.push_back({alpha, density_of(formula([alpha](std::size_t j) {
                             const double theta = std::pow(static_cast<double>(j) / nodes, 2) * oracle::pi / 2.0;
                             const double slope = std::tan(theta) / alpha;
                             return std::exp(-slope * slope) / std::pow(std::cos(theta), 4);
                         }))});
    for (const auto &[alpha, density] : cases) {
        const Material fitted = fit_mixture(density, 16, FitOptions{});
        expect_mixture(fitted.lobes, 16);
        const double truth = mean_log_likelihood({{1.0, alpha}}, density);
        EXPECT_GE(fitted.report.log_likelihood, truth - likelihood_tolerance * std::abs(truth)) << "alpha " << alpha;
        EXPECT_EQ(fitted.report.log_likelihood, mean_log_likelihood(fitted.lobes, density)) << "alpha " << alpha;
        // A lobe of another width would be told from it.
        EXPECT_LT(mean_log_likelihood({{1.0, 1.01 * alpha}}, density), truth - likelihood_tolerance * std::abs(truth));
    }
}

// Two slopes need two lobes and no more, however many are asked for.
TEST(FitHard, NoMoreLobesThanSlopes) {
    const SlopeDensity density = density_of(spikes({2, 80}));
    ASSERT_EQ(nodes_with_mass(density), 2u);
    EXPECT_EQ(fit_mixture(density, 64, FitOptions{}).lobes.size(), 2u);
}

TEST(FitHard, OrderOfTheStartDoesNotMatter) {
    const SlopeDensity density = density_of(cases()[6].ndf);
    std::vector<Lobe> start{{0.2, 0.01}, {0.3, 0.1}, {0.4, 0.5}, {0.1, 3.0}};
    const EmResult wanted = climb(start, density, 1e-10, 300);
    while (std::next_permutation(start.begin(), start.end(),
                                 [](const Lobe &a, const Lobe &b) { return a.alpha < b.alpha; }))
        expect_same(climb(start, density, 1e-10, 300).lobes, wanted.lobes);
}

// Nodes in any order are the same density, and rows of a file that are not in order are no guess.
TEST(FitHard, OrderOfTheNodesDoesNotMatter) {
    const SlopeDensity density = density_of(cases()[6].ndf);
    const std::vector<Lobe> start{{0.2, 0.01}, {0.3, 0.1}, {0.4, 0.5}, {0.1, 3.0}};
    const std::vector<Lobe> wanted = climb(start, density, 1e-10, 300).lobes;
    test::Random random(31);
    for (int turn = 0; turn < 4; ++turn) {
        SlopeDensity turned = density;
        for (std::size_t k = nodes - 1; k > 0; --k) {
            const std::size_t other = random.below(k + 1);
            for (std::vector<double> *list : {&turned.slope, &turned.p22, &turned.area, &turned.mass})
                std::swap((*list)[k], (*list)[other]);
        }
        expect_same(climb(start, turned, 1e-10, 300).lobes, wanted);
    }
    const double theta[] = {0.0, 0.5, 0.2}, values[] = {2.0, 0.1, 1.0};
    smx_density none = nullptr;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "theta",
                     smx_density_from_samples("turned", SMX_DENSITY_P22, 3, theta, values, &none));
}

TEST(FitHard, OrderOfTheChannelsDoesNotMatter) {
    const std::vector<double> values = table_values("builtin:two-layer");
    std::vector<double> turned(values.begin() + static_cast<std::ptrdiff_t>(cells), values.end());
    turned.insert(turned.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(cells));
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
        const test::Material a = fit_values(values, model), b = fit_values(turned, model);
        expect_same(mixture_of(b), mixture_of(a));
        const test::Curves wanted = test::curves_of(a), got = test::curves_of(b);
        const std::size_t knots = wanted.theta_d.size();
        const double largest = *std::max_element(wanted.fresnel.begin(), wanted.fresnel.end());
        for (std::size_t k = 0; k < wanted.fresnel.size(); ++k) {
            const std::size_t set = k / (3 * knots), channel = k / knots % 3, knot = k % knots;
            EXPECT_NEAR(got.fresnel[(3 * set + (channel + 2) % 3) * knots + knot], wanted.fresnel[k],
                        order_tolerance * largest);
        }
    }
}

// A shared model's curves carry a table's scale, and nothing else does.
TEST(FitHard, SharedModelScalesWithTheTable) {
    const std::vector<double> values = table_values("analytic:ggx,alpha=0.2,f0=0.5/0.3/0.1");
    const test::Material right = fit_values(values, SMX_MODEL_SHARED);
    const std::vector<double> curves = test::curves_of(right).fresnel;
    for (const double scale : {1e-12, 1e12}) {
        std::vector<double> scaled = values;
        for (double &value : scaled) value *= scale;
        const test::Material got = fit_values(scaled, SMX_MODEL_SHARED);
        expect_same(mixture_of(got), mixture_of(right));
        const std::vector<double> scaled_curves = test::curves_of(got).fresnel;
        for (std::size_t k = 0; k < curves.size(); ++k)
            EXPECT_NEAR(scaled_curves[k] / scale, curves[k], order_tolerance * curves[k]);
    }
}

// A sampled density's unit does not matter.
TEST(FitHard, DensityHasNoUnit) {
    std::vector<double> theta, values;
    for (int k = 0; k < 90; ++k) {
        theta.push_back(k * oracle::pi / 180.0);
        values.push_back(std::pow(1.0 + std::pow(std::tan(theta.back()) / 0.3, 2), -2)); // a heavy tail needs its lobes
    }
    const auto fitted = [&](double scale) {
        std::vector<double> scaled = values;
        for (double &value : scaled) value *= scale;
        test::Density density;
        EXPECT_SMX_OK(smx_density_from_samples("scaled", SMX_DENSITY_P22, theta.size(), theta.data(), scaled.data(),
                                               density.out()));
        return mixture_of(test::fit(density, 4));
    };
    const std::vector<Lobe> wanted = fitted(1.0);
    for (const double scale : {1e-280, 1e-12, 1e12, 1e30}) expect_same(fitted(scale), wanted);
}

// No answer, no guess.
TEST(FitHard, WhatHasNoAnswerIsAnError) {
    const double theta[] = {0.0, 1.0}, none[] = {0.0, 0.0}, wrong[] = {0.0, std::nan("")};
    smx_density density = nullptr;
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "0 at every angle",
                     smx_density_from_samples("zero", SMX_DENSITY_NDF, 2, theta, none, &density));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "nan",
                     smx_density_from_samples("nan", SMX_DENSITY_NDF, 2, theta, wrong, &density));
    EXPECT_EQ(density, nullptr);

    SlopeDensity massless = density_of(spikes({0}));
    std::fill(massless.mass.begin(), massless.mass.end(), 0.0);
    EXPECT_THROW(fit_em(massless, 4, 1e-6, 100), Error);

    // Light that never comes back where it came from, though it is reflected elsewhere.
    std::vector<double> values(3 * cells, 1.0);
    for (std::size_t at = 0; at < values.size(); ++at)
        if (at / 180 % 90 == 0) values[at] = 0.0;
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_create("no retro-reflection", 180, values.data(), brdf.out()));
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "reflects nothing back", smx_density_create(brdf, nullptr, &density));
}

// All of a table in one row of theta_h, or one cell, whatever its unit: a sound material, or an error that says why;
// and nothing printed, by the solver neither.
TEST(FitHard, TablesOfOneRowOrCell) {
    struct Spot {
        std::size_t first, count; // cells
    };
    ::testing::internal::CaptureStderr();
    for (const auto &[first, count] : {Spot{0, 16200}, Spot{89 * 16200, 16200}, Spot{0, 1}})
        for (const double value : {1e-300, 1.0, 1e30})
            for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
                SCOPED_TRACE("cells from " + std::to_string(first) + ", " + std::to_string(count) + ", value " +
                             std::to_string(std::log10(value)) + ", model " + std::to_string(model));
                expect_sound_or_no_solution(first, count, value, model);
            }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}
