// The Fresnel curves on the device: linear between knots in theta_d, one curve per channel.
#include <gtest/gtest.h>

#include "close.h"
#include "random.h"
#include "support.h"

using oracle::Vec;

namespace {

// theta_d in float32 is good to 4e-4 rad near 0, and the steepest curve below changes by 1 in a knot of 1 degree.
constexpr double lookup_tolerance = 2e-2;
constexpr double smooth_tolerance = 1e-4;

std::vector<double> ratio_to_white(const std::vector<double> &curves, std::size_t knots,
                                   const std::vector<double> &theta_d) {
    const test::Material coloured = test::make_material(SMX_MODEL_SHARED, {{1.0, 0.5}}, curves, knots);
    const test::Material white = test::make_material({{1.0, 0.5}});
    std::vector<float> wi, wo;
    for (const double t : theta_d)
        for (const double sign : {1.0, -1.0}) {
            std::vector<float> &list = sign > 0.0 ? wi : wo;
            list.insert(list.end(), {static_cast<float>(sign * std::sin(t)), 0.0f, static_cast<float>(std::cos(t))});
        }
    std::vector<float> a(3 * theta_d.size()), b(a.size());
    const smx_displacement x{0.2, 0.2, 0.0, 0.0, 0.0};
    const smx_context context = test::context();
    EXPECT_SMX_OK(smx_material_eval(context, coloured, &x, SMX_G2_CORRELATED, nullptr, theta_d.size(), wi.data(),
                                    wo.data(), a.data()));
    EXPECT_SMX_OK(smx_material_eval(context, white, &x, SMX_G2_CORRELATED, nullptr, theta_d.size(), wi.data(),
                                    wo.data(), b.data()));
    std::vector<double> ratio;
    for (std::size_t k = 0; k < a.size(); ++k) ratio.push_back(static_cast<double>(a[k]) / b[k]);
    return ratio;
}

double interpolated(const std::vector<double> &curves, std::size_t knots, std::size_t channel, double theta_d) {
    const double at = theta_d / (oracle::pi / 2.0) * static_cast<double>(knots - 1);
    const std::size_t low = std::min(static_cast<std::size_t>(at), knots - 2);
    const double share = at - static_cast<double>(low);
    return curves[channel * knots + low] * (1.0 - share) + curves[channel * knots + low + 1] * share;
}

void expect_curves(const std::vector<double> &curves, std::size_t knots, double tolerance) {
    std::vector<double> theta_d{0.0, 1e-6, 1e-3};
    for (double t = 0.005; t < 1.56; t += 0.0173) theta_d.push_back(t);
    const std::vector<double> got = ratio_to_white(curves, knots, theta_d);
    for (std::size_t k = 0; k < theta_d.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_CLOSE(got[3 * k + c], interpolated(curves, knots, c, theta_d[k]), 0.0, tolerance)
                << "theta_d " << theta_d[k] << ", channel " << c << ", knots " << knots;
}

} // namespace

TEST(Fresnel, TwoKnotsAreALine) { expect_curves({0.0, 1.0, 1.0, 0.0, 0.25, 0.75}, 2, smooth_tolerance); }

TEST(Fresnel, SchlickAtEveryDegree) {
    constexpr std::size_t knots = 91;
    std::vector<double> curves;
    for (const double f0 : {0.04, 0.5, 0.95})
        for (std::size_t k = 0; k < knots; ++k) {
            const double c = std::cos(static_cast<double>(k) * oracle::pi / 180.0);
            curves.push_back(f0 + (1.0 - f0) * std::pow(1.0 - c, 5.0));
        }
    expect_curves(curves, knots, smooth_tolerance);
}

TEST(Fresnel, RandomKnots) {
    test::Random random(11);
    for (const std::size_t knots : {std::size_t{3}, std::size_t{7}, std::size_t{91}, std::size_t{181}}) {
        std::vector<double> curves(3 * knots);
        for (double &v : curves) v = random.uniform();
        expect_curves(curves, knots, lookup_tolerance);
    }
}

// The per-lobe model has a set of curves for each lobe: here one of the two lobes is dark, and the other alone is left.
TEST(Fresnel, EveryLobeHasItsCurves) {
    constexpr std::size_t knots = 3;
    const std::vector<double> dark(3 * knots, 0.0), ramp{0.1, 0.5, 0.9, 1.0, 1.0, 1.0, 0.9, 0.5, 0.1};
    const test::Material alone = test::make_material(SMX_MODEL_PER_LOBE, {{1.0, 0.3}}, ramp, knots);
    std::vector<double> both = dark;
    both.insert(both.end(), ramp.begin(), ramp.end());
    const test::Material second = test::make_material(SMX_MODEL_PER_LOBE, {{1.0, 0.1}, {1.0, 0.3}}, both, knots);
    test::Random random(12);
    const smx_displacement x{0.2, 0.1, 0.0, 0.0, 0.0};
    for (int k = 0; k < 200; ++k) {
        const Vec i = random.direction(0.05), o = random.direction(0.05);
        const float wi[3] = {static_cast<float>(i.x), static_cast<float>(i.y), static_cast<float>(i.z)};
        const float wo[3] = {static_cast<float>(o.x), static_cast<float>(o.y), static_cast<float>(o.z)};
        float a[3], b[3];
        ASSERT_SMX_OK(smx_material_eval(test::context(), alone, &x, SMX_G2_CORRELATED, nullptr, 1, wi, wo, a));
        ASSERT_SMX_OK(smx_material_eval(test::context(), second, &x, SMX_G2_CORRELATED, nullptr, 1, wi, wo, b));
        for (int c = 0; c < 3; ++c) EXPECT_CLOSE(b[c], a[c], 1e-6, 0.0);
    }
}

// A lookup that is one knot off would be seen.
TEST(Fresnel, ToleranceSeesAShiftedKnot) {
    const std::vector<double> line{0.0, 1.0, 1.0, 0.0, 0.0, 1.0};
    EXPECT_FALSE(test::is_close(interpolated(line, 2, 0, 0.5), interpolated(line, 2, 0, 0.501), 0.0, smooth_tolerance));
}
