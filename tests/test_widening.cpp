// Roughness adds in variances: a lobe widened twice is a lobe widened once by the sum, and alphas of 0 are limits.
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

} // namespace

TEST(Widening, TwiceIsOnceBySummedVariance) {
    // 0.3^2 + 0.4^2 = 0.5^2, divided between the lobe and X in three ways.
    const std::vector<float> once = eval({{1.0, 0.5}}, isotropic(0.0));
    EXPECT_LT(largest_difference(eval({{1.0, 0.3}}, isotropic(0.4)), once), sum_tolerance);
    EXPECT_LT(largest_difference(eval({{1.0, 0.4}}, isotropic(0.3)), once), sum_tolerance);
    // Adding alphas instead of variances is far off.
    EXPECT_GT(largest_difference(eval({{1.0, 0.1}}, isotropic(0.4)), once), 0.1);
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
