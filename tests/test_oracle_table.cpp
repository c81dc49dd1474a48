// The oracle's tables and its reference integral, against nodes, closed forms and brute force.
#include <gtest/gtest.h>

#include "close.h"
#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "random.h"

using oracle::Lookup;
using oracle::Masking;
using oracle::Mixture;
using oracle::Rgb;
using oracle::Table;
using oracle::Vec;

namespace {

// Two rules of integration that share only the integrand; the plain grid's own error at 1000 x 1000 nodes.
constexpr double brute_force_tolerance = 1e-3;

Table random_table(int phi_d) {
    Table t;
    t.phi_d = phi_d;
    t.values.resize(3 * t.cells());
    test::Random random(5);
    for (double &v : t.values) v = random.uniform(0.1, 1.0);
    return t;
}

Rgb grey(double value) { return {value, value, value}; }

// A facet's BRDF in closed form: the directions turned into the facet's frame.
oracle::FacetBrdf isotropic(const Mixture &m) {
    return [m](const Vec &wi, const Vec &wo, const Vec &wm) {
        const oracle::HalfDiff a = oracle::half_diff(wi, wo, wm);
        const oracle::Pair p = oracle::directions(a.theta_h, a.theta_d, a.phi_d);
        return grey(oracle::brdf(m, Masking::correlated, p.wi, p.wo));
    };
}

} // namespace

TEST(OracleTable, AnglesInvertDirections) {
    test::Random random(4);
    for (int i = 0; i < 500; ++i) {
        const double th = random.uniform(0.0, 1.5), td = random.uniform(0.01, 1.5), pd = random.uniform(-3.1, 3.1);
        const oracle::Pair p = oracle::directions(th, td, pd);
        const oracle::HalfDiff a = oracle::half_diff(p.wi, p.wo, {0.0, 0.0, 1.0});
        EXPECT_CLOSE(a.theta_h, th, 1e-12, 1e-12);
        EXPECT_CLOSE(a.theta_d, td, 1e-12, 1e-12);
        if (th > 1e-3) {
            EXPECT_CLOSE(a.phi_d, pd, 1e-9, 1e-9);
        }
    }
}

TEST(OracleTable, LinearLookupGivesNodesAndMiddles) {
    for (const int phi_d : {180, 360}) {
        const Table t = random_table(phi_d);
        const double degree = oracle::pi / 180.0;
        for (const int th : {1, 40, 88}) {
            const double u = th / 90.0, u2 = (th + 1) / 90.0;
            const oracle::HalfDiff node{u * u * oracle::pi / 2.0, 20 * degree, 179 * degree};
            EXPECT_CLOSE(oracle::lookup(t, Lookup::linear, node)[1], t.at(1, th, 20, 179), 1e-9, 0.0);
            const double um = (u + u2) / 2.0;
            const oracle::HalfDiff middle{um * um * oracle::pi / 2.0, 20 * degree, 179.5 * degree};
            const int next = 180 % phi_d;
            const double mean =
                (t.at(0, th, 20, 179) + t.at(0, th + 1, 20, 179) + t.at(0, th, 20, next) + t.at(0, th + 1, 20, next)) /
                4.0;
            EXPECT_CLOSE(oracle::lookup(t, Lookup::linear, middle)[0], mean, 1e-9, 0.0);
        }
    }
}

TEST(OracleTable, LookupClampsAndWraps) {
    const Table t = random_table(180);
    const oracle::HalfDiff past_last{oracle::pi / 2.0, oracle::pi / 2.0, 0.0};
    EXPECT_CLOSE(oracle::lookup(t, Lookup::linear, past_last)[2], t.at(2, 89, 89, 0), 1e-12, 0.0);
    EXPECT_CLOSE(oracle::lookup(t, Lookup::nearest, past_last)[2], t.at(2, 89, 89, 0), 1e-12, 0.0);
    const oracle::HalfDiff a{0.3, 0.4, -0.5}, b{0.3, 0.4, oracle::pi - 0.5};
    EXPECT_CLOSE(oracle::lookup(t, Lookup::linear, a)[0], oracle::lookup(t, Lookup::linear, b)[0], 1e-9, 0.0);
    EXPECT_EQ(oracle::lookup(t, Lookup::nearest, a)[0], oracle::lookup(t, Lookup::nearest, b)[0]);
}

TEST(OracleTable, HorizonIsMinusOne) {
    const Table t = oracle::make_table(180, [](const Vec &, const Vec &) { return grey(1.0); });
    EXPECT_EQ(t.at(0, 0, 89, 0), 1.0);
    EXPECT_EQ(t.at(0, 89, 89, 0), -1.0);
    EXPECT_EQ(t.at(0, 89, 89, 90), 1.0);
}

TEST(OracleReference, AgreesWithBruteForce) {
    const oracle::FacetBrdf f = isotropic({{{0.5, 0.05}, {0.5, 0.4}}, {}});
    const Vec wi = oracle::spherical(1.45, 0.3), wo = oracle::spherical(1.45, 2.9);
    for (const oracle::Gaussian &x : {oracle::gaussian(0.25, 0.25), oracle::gaussian(0.2, 0.4, 0.6, 0.02, 0.03)}) {
        const oracle::Integral fine = oracle::reference(f, Masking::correlated, x, wi, wo);
        EXPECT_LT(fine.error, brute_force_tolerance);
        const Rgb plain = oracle::reference_by_grid(f, Masking::correlated, x, wi, wo, 1000);
        EXPECT_CLOSE(fine.rgb[0], plain[0], brute_force_tolerance, 0.0);
        // A wrong masking is far outside the tolerance.
        const Rgb wrong = oracle::reference_by_grid(f, Masking::coinciding, x, wi, wo, 1000);
        EXPECT_FALSE(test::is_close(fine.rgb[0], wrong[0], brute_force_tolerance, 0.0));
    }
}

TEST(OracleReference, LinesAndPointsAreLimits) {
    const oracle::FacetBrdf f = isotropic({{{1.0, 0.1}}, {}});
    const Vec wi = oracle::spherical(0.7, 0.3), wo = oracle::spherical(0.5, 2.9);
    const auto value = [&](double ax, double ay) {
        return oracle::reference(f, Masking::correlated, oracle::gaussian(ax, ay), wi, wo).rgb[0];
    };
    EXPECT_CLOSE(value(0.25, 0.0), value(0.25, 1e-3), 1e-3, 0.0);
    EXPECT_CLOSE(value(0.0, 0.25), value(1e-3, 0.25), 1e-3, 0.0);
    EXPECT_CLOSE(value(0.0, 0.0), value(1e-3, 1e-3), 1e-3, 0.0);
    const Mixture undisplaced{{{1.0, 0.1}}, {}};
    EXPECT_CLOSE(value(0.0, 0.0), oracle::fcos(undisplaced, Masking::correlated, wi, wo), 1e-10, 0.0);
}

TEST(OracleSphere, FramesAreOrthonormalAndAnglesRight) {
    for (const int row : {0, 10, 46, 80})
        for (const int column : {5, 46, 70}) {
            const oracle::Pixel p = oracle::sphere_pixel(93, 93, column, row, 0.0);
            if (!p.on_sphere) continue;
            const double x = (column + 0.5) / 46.5 - 1.0, z = 1.0 - (row + 0.5) / 46.5;
            EXPECT_CLOSE(oracle::length(p.wi), 1.0, 1e-12, 0.0);
            EXPECT_CLOSE(oracle::dot(p.wi, p.wo), 0.0, 0.0, 1e-12); // light at the right, camera in front
            EXPECT_CLOSE(p.wi.z, x, 0.0, 1e-12);
            EXPECT_CLOSE(p.wo.z, std::sqrt(1.0 - x * x - z * z), 0.0, 1e-12);
        }
    // The camera sees a slope along x (towards +theta, downwards) with the sign of the pixel's height.
    EXPECT_GT(oracle::sphere_pixel(93, 93, 46, 20, 0.0).wo.x, 0.0);
    EXPECT_LT(oracle::sphere_pixel(93, 93, 46, 70, 0.0).wo.x, 0.0);
    EXPECT_FALSE(oracle::sphere_pixel(93, 93, 0, 0, 0.0).on_sphere);
}
