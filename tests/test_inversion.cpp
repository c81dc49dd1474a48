// Roughness in, roughness out: tables made from a Beckmann surface give its alpha and its Fresnel values back.
#include <gtest/gtest.h>

#include <numeric>

#include "close.h"
#include "support.h"

using oracle::Masking;
using oracle::Table;

namespace {

// The accuracy asked of the inversion; the table's cells limit it (seven nodes below slope 7e-3).
constexpr double alpha_tolerance = 0.01;
// Share of the density's mass that may sit elsewhere than in the closed form, from the same cells.
constexpr double mass_tolerance = 0.02;
// A Fresnel curve where the table has values on both sides: lookup between nodes at the lobe's flank.
constexpr double fresnel_tolerance = 0.02;

smx_density_info info_of(smx_density density) {
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    EXPECT_SMX_OK(smx_density_get_info(density, &info));
    return info;
}

struct Nodes {
    std::vector<double> slope, p22, mass;
};

Nodes nodes_of(smx_density density) {
    const std::size_t n = info_of(density).nodes;
    Nodes nodes{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
    EXPECT_SMX_OK(smx_density_get_nodes(density, nodes.slope.data(), nodes.p22.data(), nodes.mass.data(), n));
    return nodes;
}

void expect_alpha_back(double alpha, Masking masking, smx_masking_kernel kernel) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, alpha}}, masking));
    const test::Density density = test::make_density(brdf, kernel);
    const smx_density_info info = info_of(density);
    EXPECT_TRUE(info.converged) << "alpha " << alpha << ": " << info.iterations << " iterations";
    EXPECT_CLOSE(info.alpha, alpha, alpha_tolerance, 0.0) << "alpha of the density";
    const test::Material material = test::fit(density, 1);
    const std::vector<smx_lobe> lobes = test::lobes_of(material);
    ASSERT_EQ(lobes.size(), 1u);
    EXPECT_CLOSE(lobes[0].alpha, alpha, alpha_tolerance, 0.0) << "alpha of the one-lobe fit";
    EXPECT_CLOSE(lobes[0].weight, 1.0, 1e-12, 0.0);
}

} // namespace

class CoincidingMasking : public ::testing::TestWithParam<double> {};
TEST_P(CoincidingMasking, GivesAlphaBack) { expect_alpha_back(GetParam(), Masking::coinciding, SMX_MASKING_COINCIDES); }
INSTANTIATE_TEST_SUITE_P(Inversion, CoincidingMasking, ::testing::Values(2e-3, 5e-3, 0.02, 0.1, 0.3, 0.5));

class CorrelatedMasking : public ::testing::TestWithParam<double> {};
TEST_P(CorrelatedMasking, GivesAlphaBack) {
    expect_alpha_back(GetParam(), Masking::correlated, SMX_MASKING_CORRELATED);
}
INSTANTIATE_TEST_SUITE_P(Inversion, CorrelatedMasking, ::testing::Values(2e-3, 0.02, 0.1, 0.3, 0.5, 0.8, 1.0));

// The other kernel on the same table is known to give 0.980; the tolerance above tells them apart.
TEST(Inversion, WrongKernelIsSeen) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 1.0}}, Masking::correlated));
    const double alpha = info_of(test::make_density(brdf, SMX_MASKING_COINCIDES)).alpha;
    EXPECT_CLOSE(alpha, 0.980, 0.005, 0.0);
    EXPECT_FALSE(test::is_close(alpha, 1.0, alpha_tolerance, 0.0));
}

TEST(Inversion, DensityIsTheClosedForm) {
    for (const double alpha : {0.05, 0.4}) {
        const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, alpha}}, Masking::correlated));
        const Nodes n = nodes_of(test::make_density(brdf, SMX_MASKING_CORRELATED));
        EXPECT_CLOSE(std::accumulate(n.mass.begin(), n.mass.end(), 0.0), 1.0, 1e-9, 0.0);
        double distance = 0.0;
        for (std::size_t j = 0; j < n.slope.size(); ++j) {
            ASSERT_GE(n.slope[j], j == 0 ? 0.0 : n.slope[j - 1]);
            ASSERT_GE(n.p22[j], 0.0);
            ASSERT_GE(n.mass[j], 0.0);
            if (n.p22[j] > 0.0)
                distance += n.mass[j] * std::abs(1.0 - oracle::radial_density({{1.0, alpha}}, n.slope[j]) / n.p22[j]);
        }
        EXPECT_LT(distance, mass_tolerance) << "alpha " << alpha;
    }
}

// The table has Fresnel 1, 0.5, 0.25 in its channels at all angles. Past 75 degrees it is mostly below the horizon.
TEST(Inversion, FresnelComesBack) {
    for (const double alpha : {0.05, 0.1, 0.3}) {
        const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, alpha}}, Masking::correlated));
        const test::Material material = test::fit(test::make_density(brdf, SMX_MASKING_CORRELATED), 1);
        const test::Curves curves = test::curves_of(material);
        const std::size_t knots = curves.theta_d.size();
        for (std::size_t k = 0; curves.theta_d[k] < test::radians(75.0); k += 5)
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_CLOSE(curves.fresnel[c * knots + k], test::channel_fresnel[c], fresnel_tolerance, 0.0)
                    << "alpha " << alpha << ", channel " << c << ", theta_d " << curves.theta_d[k];
    }
}

TEST(Inversion, DensityTakesFresnelKnotsEveryDegree) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.2}}, Masking::coinciding));
    const test::Density density = test::make_density(brdf, SMX_MASKING_COINCIDES);
    const test::Curves curves = test::curves_of(test::fit(density, 2));
    EXPECT_EQ(info_of(density).fresnel_knots, 91u);
    ASSERT_EQ(curves.theta_d.size(), 91u);
    for (std::size_t k = 0; k < 91; ++k)
        EXPECT_CLOSE(curves.theta_d[k], test::radians(static_cast<double>(k)), 1e-12, 1e-12);
}

TEST(Inversion, StoppingEarlyIsReported) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.3}}, Masking::coinciding));
    smx_inversion_options options = SMX_INVERSION_OPTIONS_INIT;
    options.max_iterations = 1;
    test::Density density;
    ASSERT_SMX_OK(smx_density_create(brdf, &options, density.out()));
    const smx_density_info info = info_of(density);
    EXPECT_FALSE(info.converged);
    EXPECT_EQ(info.iterations, 1u);
    EXPECT_GT(info.change, options.tolerance);
    const smx_density_info full = info_of(test::make_density(brdf, SMX_MASKING_COINCIDES));
    EXPECT_TRUE(full.converged);
    EXPECT_LT(full.change, options.tolerance);
    EXPECT_GT(full.iterations, 1u);
}

TEST(Inversion, ZerosHaveNoSolution) {
    const Table zeros = oracle::make_table(180, [](const oracle::Vec &, const oracle::Vec &) { return oracle::Rgb{}; });
    const test::Brdf brdf = test::make_brdf(zeros);
    smx_density density = nullptr;
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "", smx_density_create(brdf, nullptr, &density));
    EXPECT_EQ(density, nullptr);
}
