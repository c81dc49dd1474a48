// Roughness adds in variances: a lobe widened twice is a lobe widened once by the sum, in either order, and alphas of 0
// are limits.
#include <gtest/gtest.h>

#include "close.h"
#include "random.h"
#include "support.h"

using oracle::Vec;

namespace {

// Two float32 computations of one value; exponents up to about 10 amplify the roundings of the alphas.
constexpr double sum_tolerance = 2e-5;
// An alpha of 1e-4 beside a lobe of 0.1 changes values by (1e-3)^2 times the exponent.
constexpr double limit_tolerance = 5e-5;
// A few roundings of doubles, relative.
constexpr double moment_tolerance = 1e-14;

std::vector<float> eval(const std::vector<oracle::Lobe> &lobes, const smx_displacement &x) {
    test::Random random(17);
    constexpr std::size_t count = 2000;
    std::vector<float> wi, wo, fcos(3 * count);
    for (std::size_t k = 0; k < count; ++k) {
        // Half vectors within the lobes: the facet that mirrors the pair has a slope of up to 1.
        const double slope = random.uniform(0.0, 0.7), phi = random.uniform(0.0, 2.0 * oracle::pi);
        const Vec wm = oracle::normalised({slope * std::cos(phi), slope * std::sin(phi), 1.0});
        Vec i = random.direction(0.05), o = oracle::reflect(i, wm);
        if (o.z < 0.02) o = i = wm;
        for (const double v : {i.x, i.y, i.z}) wi.push_back(static_cast<float>(v));
        for (const double v : {o.x, o.y, o.z}) wo.push_back(static_cast<float>(v));
    }
    EXPECT_SMX_OK(smx_material_eval(test::context(), test::make_material(lobes), &x, SMX_G2_CORRELATED, nullptr, count,
                                    wi.data(), wo.data(), fcos.data()));
    return fcos;
}

double largest_difference(const std::vector<float> &a, const std::vector<float> &b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (!std::isfinite(a[k]) || !std::isfinite(b[k])) return HUGE_VAL;
        const double scale = std::max({std::abs(a[k]), std::abs(b[k]), 1e-12f});
        largest = std::max(largest, std::abs(static_cast<double>(a[k]) - b[k]) / scale);
    }
    return largest;
}

smx_displacement isotropic(double alpha) { return {alpha, alpha, 0.0, 0.0, 0.0}; }

smx_displacement sum(const smx_displacement &x, const smx_displacement &y) {
    smx_displacement both{};
    EXPECT_SMX_OK(smx_displacement_add(&x, &y, &both));
    return both;
}

bool equal(const smx_displacement &x, const smx_displacement &y) {
    return x.alpha_x == y.alpha_x && x.alpha_y == y.alpha_y && x.rho == y.rho && x.mean_slope_x == y.mean_slope_x &&
           x.mean_slope_y == y.mean_slope_y;
}

// Alphas 1e-4..1e3, up to 1e4 apart, and 0; correlations to 1 - 1e-6.
smx_displacement random_surface(test::Random &random) {
    const auto alpha = [&] { return random.below(8) == 0 ? 0.0 : random.log_uniform(1e-4, 1e3); };
    const double rho = 1.0 - random.log_uniform(1e-6, 1.0);
    return {alpha(), alpha(), random.below(2) ? rho : -rho, random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
}

void expect_same(const smx_displacement &got, const oracle::Gaussian &wanted) {
    const oracle::Gaussian g = test::gaussian(got);
    const double scale = std::sqrt(wanted.cov_xx * wanted.cov_yy);
    EXPECT_CLOSE(g.cov_xx, wanted.cov_xx, moment_tolerance, 0.0);
    EXPECT_CLOSE(g.cov_yy, wanted.cov_yy, moment_tolerance, 0.0);
    EXPECT_CLOSE(g.cov_xy, wanted.cov_xy, 0.0, moment_tolerance * scale);
    EXPECT_CLOSE(g.mean_x, wanted.mean_x, 0.0, 10.0 * moment_tolerance);
    EXPECT_CLOSE(g.mean_y, wanted.mean_y, 0.0, 10.0 * moment_tolerance);
}

} // namespace

TEST(Widening, TwiceIsOnceBySummedVariance) {
    // 0.3^2 + 0.4^2 = 0.5^2, divided between the lobe and X in three ways.
    const std::vector<float> once = eval({{1.0, 0.5}}, isotropic(0.0));
    EXPECT_LT(largest_difference(eval({{1.0, 0.3}}, isotropic(0.4)), once), sum_tolerance);
    EXPECT_LT(largest_difference(eval({{1.0, 0.4}}, isotropic(0.3)), once), sum_tolerance);
    // Adding alphas instead of variances is far off.
    EXPECT_GT(largest_difference(eval({{1.0, 0.1}}, isotropic(0.4)), once), 0.1);
}

TEST(Widening, MomentsAdd) {
    test::Random random(23);
    for (int k = 0; k < 20000; ++k) {
        const smx_displacement x = random_surface(random), y = random_surface(random), z = random_surface(random);
        const smx_displacement both = sum(x, y);
        const oracle::Gaussian a = test::gaussian(x), b = test::gaussian(y), c = test::gaussian(z);
        const auto add = [](const oracle::Gaussian &p, const oracle::Gaussian &q) -> oracle::Gaussian {
            return {p.mean_x + q.mean_x, p.mean_y + q.mean_y, p.cov_xx + q.cov_xx, p.cov_xy + q.cov_xy,
                    p.cov_yy + q.cov_yy};
        };
        expect_same(both, add(a, b));
        expect_same(sum(both, z), add(add(a, b), c));
        expect_same(sum(x, sum(y, z)), add(add(a, b), c));
        EXPECT_TRUE(equal(sum(y, x), both));
        EXPECT_TRUE(equal(sum(x, {}), x) || x.alpha_x * x.alpha_y == 0.0);

        // In place of either.
        smx_displacement in_place = x;
        EXPECT_SMX_OK(smx_displacement_add(&in_place, &y, &in_place));
        EXPECT_TRUE(equal(in_place, both));
        in_place = y;
        EXPECT_SMX_OK(smx_displacement_add(&x, &in_place, &in_place));
        EXPECT_TRUE(equal(in_place, both));
        if (::testing::Test::HasFailure()) break;
    }
}

// The most correlated that there are, and the least alphas: the sum is a surface too.
TEST(Widening, MomentsAddAtTheEndsOfTheirRange) {
    const double most = std::nextafter(1.0, 0.0);
    for (const double scale : {1e-300, 1.0, 5e3})
        for (const double rho : {most, -most}) {
            const smx_displacement x{0.3 * scale, scale, rho, 0.0, 0.0};
            const smx_displacement both = sum(x, x);
            EXPECT_LE(std::abs(both.rho), most);
            EXPECT_CLOSE(both.rho, rho, 1e-15, 0.0);
        }
    EXPECT_EQ(sum({}, {}).rho, 0.0);
}

// A lobe on X and then on Y, by hand: X's isotropic roughness taken into the lobe.
TEST(Widening, OneSurfaceAfterTheOtherIsTheirSum) {
    const smx_displacement fine = isotropic(0.3), coarse{0.4, 0.2, -0.6, 0.1, 0.0};
    const double alpha = std::hypot(0.1, 0.3);
    EXPECT_LT(largest_difference(eval({{1.0, 0.1}}, sum(fine, coarse)), eval({{1.0, alpha}}, coarse)), sum_tolerance);
    EXPECT_LT(largest_difference(eval({{1.0, 0.1}}, sum(coarse, fine)), eval({{1.0, alpha}}, coarse)), sum_tolerance);
    EXPECT_GT(largest_difference(eval({{1.0, 0.1}}, coarse), eval({{1.0, alpha}}, coarse)), 0.1);
}

TEST(Widening, EveryLobeWidens) {
    const std::vector<float> narrow = eval({{0.25, 0.06}, {0.75, 0.24}}, isotropic(0.32));
    const std::vector<float> wide = eval({{0.25, std::sqrt(0.06 * 0.06 + 0.32 * 0.32)}, {0.75, 0.4}}, isotropic(0.0));
    EXPECT_LT(largest_difference(narrow, wide), sum_tolerance);
}

TEST(Widening, AxesAreSeparate) {
    const std::vector<float> a = eval({{1.0, 0.3}}, {0.4, 0.0, 0.0, 0.1, 0.2});
    const std::vector<float> b = eval({{1.0, 0.18}}, {std::sqrt(0.25 - 0.0324), 0.24, 0.0, 0.1, 0.2});
    EXPECT_LT(largest_difference(a, b), sum_tolerance);
}

TEST(Widening, ZeroAlphasAreLimits) {
    const std::vector<oracle::Lobe> lobes{{1.0, 0.1}};
    EXPECT_LT(largest_difference(eval(lobes, {0.3, 0.0, 0.0, 0.0, 0.0}), eval(lobes, {0.3, 1e-4, 0.0, 0.0, 0.0})),
              limit_tolerance);
    EXPECT_LT(largest_difference(eval(lobes, {0.0, 0.3, 0.0, 0.0, 0.0}), eval(lobes, {1e-4, 0.3, 0.0, 0.0, 0.0})),
              limit_tolerance);
    EXPECT_LT(largest_difference(eval(lobes, isotropic(0.0)), eval(lobes, isotropic(1e-4))), limit_tolerance);
}

TEST(Widening, CorrelationMeansNothingOnALine) {
    const std::vector<oracle::Lobe> lobes{{1.0, 0.1}};
    EXPECT_EQ(largest_difference(eval(lobes, {0.3, 0.0, 0.9, 0.0, 0.0}), eval(lobes, {0.3, 0.0, 0.0, 0.0, 0.0})), 0.0);
}
