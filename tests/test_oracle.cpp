// The oracle against definitions and identities that do not share its formulas, and wrong formulas that the same
// checks catch.
#include <gtest/gtest.h>

#include <functional>

#include "close.h"
#include "oracle.h"
#include "random.h"

using oracle::Gaussian;
using oracle::Masking;
using oracle::Mixture;
using oracle::Vec;

namespace {

// Midpoints of a smooth integrand over 8.5 deviations on 600 x 600 nodes: errors below 1e-6.
constexpr double integral_tolerance = 1e-6;
// The same where the integrand has a kink along a line (max(0, .)) or ends at the horizon.
constexpr double kink_tolerance = 2e-4;

// Integral over the plane of slopes of g(slope_x, slope_y) p22.
double mean_over_slopes(const Gaussian &x, const std::function<double(double, double)> &g) {
    constexpr int n = 600;
    const double rx = 8.5 * std::sqrt(x.cov_xx), ry = 8.5 * std::sqrt(x.cov_yy);
    double sum = 0.0;
    for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
            const double sx = x.mean_x + rx * ((j + 0.5) * 2.0 / n - 1.0);
            const double sy = x.mean_y + ry * ((k + 0.5) * 2.0 / n - 1.0);
            sum += oracle::p22(x, sx, sy) * g(sx, sy);
        }
    return sum * 4.0 * rx * ry / n / n;
}

// sigma by its definition: the mean projected area of the facets that face k, per unit of mean plane.
double sigma_by_definition(const Gaussian &x, const Vec &k) {
    return mean_over_slopes(x, [&](double sx, double sy) { return std::max(0.0, k.z - k.x * sx - k.y * sy); });
}

const std::vector<Gaussian> &surfaces() {
    static const std::vector<Gaussian> list{
        oracle::gaussian(0.3, 0.3),
        oracle::gaussian(0.1, 0.8),
        oracle::gaussian(1.0, 1.0),
        oracle::gaussian(0.4, 0.2, 0.9),
        oracle::gaussian(0.5, 0.3, -0.5, 0.4, -0.2),
    };
    return list;
}

double integral_over_hemisphere(const std::function<double(const Vec &)> &g, int n = 700) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j)
        for (int k = 0; k < 2 * n; ++k) {
            const double theta = (j + 0.5) * oracle::pi / 2.0 / n, phi = (k + 0.5) * oracle::pi / n;
            sum += g(oracle::spherical(theta, phi)) * std::sin(theta);
        }
    return sum * oracle::pi / 2.0 / n * oracle::pi / n;
}

} // namespace

TEST(Oracle, SlopeDensityHasItsMoments) {
    for (const Gaussian &x : surfaces()) {
        EXPECT_CLOSE(mean_over_slopes(x, [](double, double) { return 1.0; }), 1.0, integral_tolerance, 0.0);
        EXPECT_CLOSE(mean_over_slopes(x, [](double sx, double) { return sx; }), x.mean_x, integral_tolerance, 1e-9);
        const auto product = [&](double sx, double sy) { return (sx - x.mean_x) * (sy - x.mean_y); };
        EXPECT_CLOSE(mean_over_slopes(x, product), x.cov_xy, integral_tolerance, 1e-9);
    }
}

TEST(Oracle, AlphaIsRootTwoTimesTheDeviation) {
    const Gaussian x = oracle::gaussian(0.3, 0.3);
    const auto square = [](double sx, double sy) { return sx * sx + sy * sy; };
    EXPECT_CLOSE(mean_over_slopes(x, square), 0.09, integral_tolerance, 0.0);
    // The wrong reading, alpha = deviation, is seen by this check.
    const Gaussian wrong{0.0, 0.0, 0.09, 0.0, 0.09};
    EXPECT_FALSE(test::is_close(mean_over_slopes(wrong, square), 0.09, integral_tolerance, 0.0));
}

TEST(Oracle, SigmaIsTheMeanProjectedArea) {
    test::Random random(1);
    for (const Gaussian &x : surfaces())
        for (int i = 0; i < 6; ++i) {
            const Vec k = random.direction();
            EXPECT_CLOSE(oracle::sigma(x, k), sigma_by_definition(x, k), kink_tolerance, kink_tolerance)
                << "k = " << k.x << " " << k.y << " " << k.z;
        }
}

TEST(Oracle, SigmaCheckCatchesAMissingTerm) {
    const Gaussian x = oracle::gaussian(1.0, 1.0);
    const Vec k = oracle::spherical(1.4, 0.3);
    const double s = std::sin(1.4), v = k.z / s;
    const double without_gaussian_term = k.z * (1.0 + std::erf(v)) / 2.0;
    const double without_half = k.z * (1.0 + std::erf(v)) / 2.0 + s * std::exp(-v * v) / std::sqrt(oracle::pi);
    const double truth = sigma_by_definition(x, k);
    EXPECT_FALSE(test::is_close(without_gaussian_term, truth, kink_tolerance, kink_tolerance));
    EXPECT_FALSE(test::is_close(without_half, truth, kink_tolerance, kink_tolerance));
}

TEST(Oracle, SigmaHasItsLimits) {
    const Vec grazing{1.0, 0.0, 0.0};
    EXPECT_CLOSE(oracle::sigma(oracle::gaussian(0.5, 0.1), grazing), 0.5 / (2.0 * std::sqrt(oracle::pi)), 1e-14, 0.0);
    EXPECT_CLOSE(oracle::sigma(oracle::gaussian(0.5, 0.5), Vec{0.0, 0.0, 1.0}), 1.0, 1e-15, 0.0);
    const Vec k = oracle::spherical(1.2, 2.0);
    EXPECT_CLOSE(oracle::sigma(oracle::gaussian(0.0, 0.0), k), k.z, 1e-15, 0.0);
    EXPECT_CLOSE(oracle::sigma(oracle::gaussian(0.3, 0.0), k), oracle::sigma(oracle::gaussian(0.3, 1e-9), k), 1e-9,
                 0.0);
}

// Integral of D(m) <m, k>+ over normals is sigma(k): of D cos it is 1.
TEST(Oracle, NormalsProjectToSigma) {
    const Gaussian x = oracle::gaussian(0.3, 0.6, 0.4);
    for (const Vec &k : {Vec{0.0, 0.0, 1.0}, oracle::spherical(1.0, 0.7), oracle::spherical(1.5, 4.0)}) {
        const auto projected = [&](const Vec &m) { return oracle::ndf(x, m) * std::max(0.0, oracle::dot(m, k)); };
        EXPECT_CLOSE(integral_over_hemisphere(projected), oracle::sigma(x, k), kink_tolerance, 0.0);
    }
}

TEST(Oracle, MixtureMasksBySummedAreas) {
    const Mixture m{{{0.25, 0.1}, {0.75, 0.9}}, {}};
    const Vec k = oracle::spherical(1.3, 0.0);
    const double g1_1 = oracle::g1(oracle::gaussian(0.1, 0.1), k), g1_2 = oracle::g1(oracle::gaussian(0.9, 0.9), k);
    EXPECT_CLOSE(k.z / oracle::sigma(m, k), 1.0 / (0.25 / g1_1 + 0.75 / g1_2), 1e-14, 0.0);
    EXPECT_FALSE(test::is_close(k.z / oracle::sigma(m, k), 0.25 * g1_1 + 0.75 * g1_2, 1e-3, 0.0));
}

TEST(Oracle, MaskingFormsAreOrdered) {
    const Mixture m{{{1.0, 0.7}}, {}};
    test::Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Vec wi = random.direction(), wo = random.direction();
        const double separable = oracle::g2(Masking::separable, m, wi, wo);
        const double correlated = oracle::g2(Masking::correlated, m, wi, wo);
        const double coinciding = oracle::g2(Masking::coinciding, m, wi, wo);
        EXPECT_LE(separable, correlated * (1.0 + 1e-12));
        EXPECT_LE(correlated, coinciding * (1.0 + 1e-12));
    }
}

// Weak white furnace (Heitz 2014): with G1(o) alone in the place of G2, all light comes back, up or down.
TEST(Oracle, WeakWhiteFurnaceIsOne) {
    const Gaussian x = oracle::gaussian(0.5, 0.3);
    const Vec wo = oracle::spherical(1.2, 0.4);
    const auto scattered = [&](const Vec &m) { // dwi = 4 <o,m> dm
        return oracle::ndf(x, m) * oracle::g1(x, wo) * std::max(0.0, oracle::dot(wo, m)) / wo.z;
    };
    EXPECT_CLOSE(integral_over_hemisphere(scattered), 1.0, kink_tolerance, 0.0);
}

TEST(Oracle, ShadingIsReciprocal) {
    const Mixture m{{{0.3, 0.05}, {0.7, 0.6}}, oracle::gaussian(0.3, 0.2, 0.5, 0.1, -0.3)};
    test::Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Vec wi = random.direction(0.4), wo = random.direction(0.4);
        for (const Masking g : {Masking::correlated, Masking::separable})
            EXPECT_CLOSE(oracle::brdf(m, g, wi, wo), oracle::brdf(m, g, wo, wi), 1e-12, 0.0);
    }
}

TEST(Oracle, WideningAddsVariances) {
    const Gaussian twice = oracle::widened(oracle::gaussian(0.3, 0.0, 0.0, 0.2, 0.1), 0.4);
    EXPECT_CLOSE(twice.cov_xx, 0.25 / 2.0, 1e-15, 0.0);
    EXPECT_CLOSE(twice.cov_yy, 0.16 / 2.0, 1e-15, 0.0);
    EXPECT_EQ(twice.mean_x, 0.2);
}

TEST(Close, NanEqualsNothing) {
    const double nan = std::nan(""), inf = HUGE_VAL;
    EXPECT_FALSE(test::is_close(nan, nan, 1.0, 1.0));
    EXPECT_FALSE(test::is_close(nan, 1.0, 1.0, 1.0));
    EXPECT_FALSE(test::is_close(1.0, inf, 1.0, 1.0));
    EXPECT_FALSE(test::is_close(nan, inf, 1.0, 1.0));
    EXPECT_TRUE(test::is_close(inf, inf, 0.0, 0.0));
    EXPECT_FALSE(test::is_close(1.0, 1.1, 0.01, 0.0));
}
