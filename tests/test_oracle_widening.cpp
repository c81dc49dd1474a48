// The oracle of widening against a plain grid, the other adaptive oracle, and cases that come down to one dimension or
// to none; a base that is a little wrong is told apart by the same checks.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "close.h"
#include "oracle_widening.h"
#include "random.h"

using oracle::Base;
using oracle::Gaussian;
using oracle::Lobe;
using oracle::Masking;
using oracle::Vec;

namespace {

// The adaptive rules ask for 1e-6 of the value.
constexpr double tolerance = 2e-6;
// Midpoints, 1500 x 1500 over 7 deviations: a lobe of 0.1 is smooth to them, but not the edge of what is seen.
constexpr double grid_tolerance = 1e-4;

const std::vector<Lobe> base_lobes{{0.7, 0.1}, {0.3, 0.6}};

struct Pair {
    Vec wi, wo;
};

std::vector<Pair> pairs(const Gaussian &x, int count) {
    test::Random random(5);
    std::vector<Pair> list;
    while (static_cast<int>(list.size()) < count) {
        const Pair p{random.direction(0.05), random.direction(0.05)};
        if (oracle::plane(x, p.wi) > 0.05 && oracle::plane(x, p.wo) > 0.05) list.push_back(p);
    }
    return list;
}

} // namespace

TEST(OracleWidening, IsTheGrids) {
    for (const Gaussian &x : {oracle::gaussian(0.3, 0.3), oracle::gaussian(0.5, 0.2, 0.8, 0.3, -0.4)})
        for (const Base base : {Base::shared, Base::per_lobe})
            for (const Masking masking : {Masking::correlated, Masking::separable})
                for (const auto &[wi, wo] : pairs(x, 4)) {
                    const auto adaptive = oracle::widened_fcos(base, base_lobes, masking, x, wi, wo);
                    const double grid = oracle::reference_by_grid(oracle::lobes_brdf(base, base_lobes, masking),
                                                                  masking, x, wi, wo, 700)[0];
                    EXPECT_CLOSE(adaptive.value, grid, grid_tolerance, 1e-12);
                    EXPECT_LE(adaptive.error, tolerance * adaptive.value + 1e-300);
                    // Lobes 2 % wider are told apart.
                    const std::vector<Lobe> wider{{0.7, 0.102}, {0.3, 0.612}};
                    const double wrong = oracle::widened_fcos(base, wider, masking, x, wi, wo).value;
                    EXPECT_FALSE(test::is_close(wrong, grid, grid_tolerance, 1e-12));
                }
}

// The line of slopes, by midpoints.
TEST(OracleWidening, IsTheReferencesOnALine) {
    for (const Gaussian &x : {oracle::gaussian(0.4, 0.0, 0.0, 0.1, -0.2), oracle::gaussian(0.0, 0.4)})
        for (const auto &[wi, wo] : pairs(x, 10)) {
            const oracle::Integral reference = oracle::reference(
                oracle::lobes_brdf(Base::per_lobe, base_lobes, Masking::correlated), Masking::correlated, x, wi, wo);
            const auto adaptive = oracle::widened_fcos(Base::per_lobe, base_lobes, Masking::correlated, x, wi, wo);
            EXPECT_CLOSE(adaptive.value, reference.rgb[0], 1e-5, 1e-12);
        }
}

TEST(OracleWidening, IsTheBaseWhereXIsSmooth) {
    const std::vector<Lobe> lobes{{1.0, 1e-4}};
    test::Random random(6);
    for (int k = 0; k < 20; ++k) {
        const Vec wi = random.direction(0.1), wm{1e-4 * random.uniform(), 0.0, 1.0};
        const Vec wo = oracle::reflect(wi, oracle::normalised(wm));
        const double base = oracle::fcos({lobes, {}}, Masking::correlated, wi, wo);
        EXPECT_CLOSE(oracle::widened_fcos(Base::shared, lobes, Masking::correlated, {}, wi, wo).value, base, 1e-7, 0.0);
        const Gaussian x = oracle::gaussian(1e-8, 1e-8);
        EXPECT_CLOSE(oracle::widened_fcos(Base::shared, lobes, Masking::correlated, x, wi, wo).value, base, 1e-6, 0.0);
    }
}

// Light and viewer above an isotropic X: one integral over the tilt, for the sharpest and the widest lobes.
TEST(OracleWidening, IsRadialFromAbove) {
    const Vec up{0.0, 0.0, 1.0};
    for (const double alpha : {1e-4, 1e-2, 0.3, 3.0, 20.0})
        for (const double rough : {0.02, 0.5, 2.0}) {
            const double width = alpha * rough / std::hypot(alpha, rough);
            const auto facet = [&](double u) {
                const double r = width * std::sinh(u), tan2 = r * r, cosine = 1.0 / std::sqrt(1.0 + tan2);
                const double lobe = std::exp(-tan2 / (alpha * alpha)) / (oracle::pi * alpha * alpha);
                const double surface = std::exp(-tan2 / (rough * rough)) / (oracle::pi * rough * rough);
                const double v = 1.0 / (alpha * r), s = alpha * r * cosine;
                const double sigma =
                    r == 0.0 ? 1.0
                             : cosine * std::erfc(-v) / 2.0 + s * std::exp(-v * v) / (2.0 * std::sqrt(oracle::pi));
                const double g2 = cosine / (2.0 * sigma - cosine);
                return lobe * (1.0 + tan2) * (1.0 + tan2) * g2 * surface / cosine * 2.0 * oracle::pi * r * width *
                       std::cosh(u);
            };
            const double far = std::asinh(8.0 * rough / width);
            const double wanted =
                boost::math::quadrature::gauss_kronrod<double, 31>::integrate(facet, 0.0, far, 15, 1e-10) / 4.0;
            const double got = oracle::widened_fcos(Base::per_lobe, {{1.0, alpha}}, Masking::correlated,
                                                    oracle::gaussian(rough, rough), up, up)
                                   .value;
            EXPECT_CLOSE(got, wanted, tolerance, 0.0);
        }
}
