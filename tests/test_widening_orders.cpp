// Lobes widened by quadrature, against the integral that they converge to (oracle_widening.h), and by themselves:
// limits, continuity, numbers everywhere, grades, and the orders that auto chooses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "directions.h"
#include "oracle_widening.h"
#include "random.h"
#include "support.h"

using oracle::Base;
using oracle::Lobe;
using oracle::Vec;

namespace {

struct Scenery {
    std::vector<Lobe> lobes;
    smx_displacement x;
    Base base = Base::per_lobe;
    smx_masking masking = SMX_G2_CORRELATED;
};

test::Material material_of(const Scenery &s) {
    if (s.base == Base::shared) return test::make_material(s.lobes);
    std::vector<test::Colour> colours;
    for (const Lobe &lobe : s.lobes) colours.push_back({lobe.weight, lobe.weight, lobe.weight});
    return test::make_per_lobe_material(s.lobes, colours);
}

std::vector<double> eval(const Scenery &s, const test::Directions &pairs, int order,
                         smx_grade grade = SMX_GRADE_PRECISE, smx_context where = test::context()) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.widening_order = order;
    options.grade = grade;
    std::vector<float> fcos(3 * pairs.count());
    EXPECT_SMX_OK(smx_material_eval(where, material_of(s), &s.x, s.masking, &options, pairs.count(), pairs.wi.data(),
                                    pairs.wo.data(), fcos.data()));
    std::vector<double> values;
    for (std::size_t k = 0; k < pairs.count(); ++k) values.push_back(fcos[3 * k]);
    return values;
}

std::vector<double> exact(const Scenery &s, const test::Directions &pairs) {
    std::vector<double> values;
    for (std::size_t k = 0; k < pairs.count(); ++k) {
        const oracle::Estimate e =
            oracle::widened_fcos(s.base, s.lobes, test::masking(s.masking), test::gaussian(s.x),
                                 test::Directions::at(pairs.wi, k), test::Directions::at(pairs.wo, k));
        EXPECT_LE(e.error, 1e-5 * e.value + 1e-20) << "the oracle's own error";
        values.push_back(e.value);
    }
    return values;
}

double relrmse(const std::vector<double> &a, const std::vector<double> &b) {
    double error2 = 0.0, value2 = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) error2 += (a[k] - b[k]) * (a[k] - b[k]), value2 += b[k] * b[k];
    return value2 > 0.0 ? std::sqrt(error2 / value2) : 0.0;
}

enum class Half { within_lobes, at_pole, grazing };

// A facet that mirrors the pair.
Vec facet(const Scenery &s, Half half, test::Random &random) {
    const double phi = random.uniform(0.0, 2.0 * oracle::pi);
    if (half == Half::grazing) return oracle::spherical(std::acos(random.log_uniform(0.01, 0.3)), phi);
    const double radius = half == Half::at_pole ? random.log_uniform(1e-6, 1e-2) : random.uniform(0.0, 2.0);
    if (half == Half::at_pole) return oracle::normalised({radius * std::cos(phi), radius * std::sin(phi), 1.0});
    const double alpha = std::min(s.lobes[random.below(s.lobes.size())].alpha, 1.0);
    const double slope_x = s.x.mean_slope_x + radius * std::cos(phi) * std::hypot(s.x.alpha_x, alpha);
    const double slope_y = s.x.mean_slope_y + radius * std::sin(phi) * std::hypot(s.x.alpha_y, alpha);
    return oracle::normalised({-slope_x, -slope_y, 1.0});
}

test::Directions make_pairs(const Scenery &s, Half half, test::Random &random, std::size_t count) {
    const oracle::Gaussian x = test::gaussian(s.x);
    test::Directions pairs;
    for (int tries = 0; pairs.count() < count && tries < 100000; ++tries) {
        const Vec wm = facet(s, half, random);
        const Vec around = random.direction();
        const Vec wi = half == Half::grazing ? oracle::normalised(wm + random.uniform(0.0, 0.5) * around) : around;
        const Vec wo = oracle::reflect(wi, wm);
        if (std::min({wi.z, wo.z, oracle::plane(x, wi), oracle::plane(x, wo)}) > 0.01) pairs.add(wi, wo);
    }
    return pairs;
}

struct Interval {
    double low, high;
};

// A class of sceneries, and the largest relRMSE over the pairs of one that order 8 may have.
struct Class {
    const char *name;
    Interval alpha, x;
    double least_over_most; // of X's alphas; 0: a line. 1: any in x
    Half half;
    double largest;
};

Scenery random_scenery(const Class &c, test::Random &random, int number) {
    Scenery s;
    const double share = number % 2 ? 0.6 : 1.0;
    s.lobes.push_back({share, random.log_uniform(c.alpha.low, c.alpha.high)});
    if (share < 1.0) s.lobes.push_back({1.0 - share, random.log_uniform(c.alpha.low, c.alpha.high)});
    s.x = {random.log_uniform(c.x.low, c.x.high), random.log_uniform(c.x.low, c.x.high), random.uniform(-0.9, 0.9),
           random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
    if (c.least_over_most < 1.0) (number % 4 < 2 ? s.x.alpha_x : s.x.alpha_y) *= c.least_over_most;
    return s;
}

void expect_converged(const Class &c, Base base, smx_masking masking) {
    test::Random random(7);
    double largest = 0.0;
    int seen = 0;
    for (int number = 0; number < 6; ++number) {
        Scenery s = random_scenery(c, random, number);
        s.base = base, s.masking = masking;
        const test::Directions pairs = make_pairs(s, c.half, random, 12);
        ASSERT_GT(pairs.count(), 0U);
        const std::vector<double> wanted = exact(s, pairs);
        // A sharp lobe may be seen in none of them.
        if (*std::max_element(wanted.begin(), wanted.end()) < 1e-15) continue;
        largest = std::max(largest, relrmse(eval(s, pairs, 8), wanted));
        ++seen;
    }
    EXPECT_GE(seen, 3) << c.name;
    EXPECT_LT(largest, c.largest) << c.name << ", base " << static_cast<int>(base) << ", masking " << masking;
    ::testing::Test::RecordProperty(std::string("relrmse_") + c.name, std::to_string(largest));
}

smx_context context_of(std::uint32_t width) {
    static std::vector<test::Context> kept;
    kept.emplace_back();
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.vector_width = width;
    EXPECT_SMX_OK(smx_context_create(&options, kept.back().out()));
    return kept.back();
}

} // namespace

// Order 8 within 1 % of the integral where lobes are no wider than 2 and X no rougher than 1.
TEST(WideningOrders, EighthIsTheIntegral) {
    const Interval moderate_x{0.05, 0.5};
    for (const Class &c : std::vector<Class>{{"random", {0.01, 2.0}, moderate_x, 1.0, Half::within_lobes, 0.01},
                                             {"sharp", {1e-4, 0.01}, moderate_x, 1.0, Half::within_lobes, 0.01},
                                             {"flat", {1e-4, 2.0}, moderate_x, 1e-4, Half::within_lobes, 0.011},
                                             {"line", {0.01, 2.0}, moderate_x, 0.0, Half::within_lobes, 0.015},
                                             {"rough", {0.01, 2.0}, {0.5, 1.0}, 1.0, Half::within_lobes, 0.015},
                                             {"pole", {1e-4, 2.0}, moderate_x, 1.0, Half::at_pole, 0.01}})
        expect_converged(c, Base::per_lobe, SMX_G2_CORRELATED);
}

// What is beyond 1 %: lobes wider than 2, whose density rises towards the horizon of wi and wo, and half vectors near
// the surface's own.
TEST(WideningOrders, EighthIsNearTheIntegralOfHardOnes) {
    const Interval moderate_x{0.05, 0.5};
    for (const Class &c : std::vector<Class>{{"wide", {2.0, 4.0}, moderate_x, 1.0, Half::within_lobes, 0.15},
                                             {"widest", {4.0, 20.0}, moderate_x, 1.0, Half::within_lobes, 0.25},
                                             {"grazing", {0.01, 2.0}, moderate_x, 1.0, Half::grazing, 0.03},
                                             {"grazing_line", {0.01, 2.0}, moderate_x, 0.0, Half::grazing, 0.05},
                                             {"grazing_wide", {4.0, 20.0}, moderate_x, 1.0, Half::grazing, 0.35}})
        expect_converged(c, Base::per_lobe, SMX_G2_CORRELATED);
}

TEST(WideningOrders, BothModelsAndMaskings) {
    const Class c{"models", {0.05, 1.0}, {0.05, 0.5}, 1.0, Half::within_lobes, 0.01};
    for (const Base base : {Base::shared, Base::per_lobe})
        for (const smx_masking masking : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) expect_converged(c, base, masking);
    // The oracle tells them apart.
    Scenery s{{{0.6, 0.4}, {0.4, 1.5}}, {0.3, 0.2, 0.4, 0.1, -0.2}};
    test::Random random(8);
    const test::Directions pairs = make_pairs(s, Half::grazing, random, 12);
    const std::vector<double> right = exact(s, pairs);
    const double error = relrmse(eval(s, pairs, 8), right);
    s.base = Base::shared;
    EXPECT_GT(relrmse(eval(s, pairs, 8), right), 3.0 * error);
    s.base = Base::per_lobe, s.masking = SMX_G2_SEPARABLE;
    EXPECT_GT(relrmse(eval(s, pairs, 8), right), 3.0 * error);
}

// Median over sceneries.
TEST(WideningOrders, ErrorsFall) {
    const Class c{"falls", {0.05, 1.0}, {0.2, 0.5}, 1.0, Half::within_lobes, 0.0};
    std::array<std::vector<double>, 9> errors;
    test::Random random(9);
    for (int number = 0; number < 9; ++number) {
        const Scenery s = random_scenery(c, random, number);
        const test::Directions pairs = make_pairs(s, Half::within_lobes, random, 12);
        const std::vector<double> wanted = exact(s, pairs);
        for (const std::size_t order : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 8U})
            errors[order].push_back(relrmse(eval(s, pairs, static_cast<int>(order)), wanted));
    }
    const auto median = [&](std::size_t order) {
        std::nth_element(errors[order].begin(), errors[order].begin() + 4, errors[order].end());
        RecordProperty("order " + std::to_string(order), std::to_string(errors[order][4]));
        return errors[order][4];
    };
    for (const auto &[low, high] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 3}, {2, 4}, {3, 5}, {4, 8}})
        EXPECT_LT(median(high), 0.8 * median(low)) << "orders " << low << " and " << high;
}

// The undisplaced lobe is the limit of a smooth X, and what X of no roughness gives.
TEST(WideningOrders, SmoothXIsTheBase) {
    for (const Base base : {Base::shared, Base::per_lobe})
        for (const double alpha : {0.05, 0.3, 2.0}) {
            Scenery s{{{1.0, alpha}}, {}, base};
            test::Random random(10);
            const test::Directions pairs = make_pairs(s, Half::within_lobes, random, 50);
            const std::vector<double> wanted = exact(s, pairs);
            for (const int order : {1, 2, 3, 5, 8})
                for (const auto &[alpha_x, alpha_y] :
                     {std::pair{0.0, 0.0}, {1e-4, 1e-4}, {1e-4, 0.0}, {0.0, 1e-6}, {1e-4, 1e-6}}) {
                    s.x.alpha_x = alpha_x, s.x.alpha_y = alpha_y;
                    EXPECT_LT(relrmse(eval(s, pairs, order), wanted), 1e-4)
                        << "alpha " << alpha << ", order " << order << ", X " << alpha_x << " " << alpha_y;
                }
        }
}

// At grazing wo f cos is finite, and facets nearly turned away from it are all that is seen.
TEST(WideningOrders, GrazingIsNotLost) {
    for (const double alpha : {0.3, 2.0}) {
        Scenery s{{{1.0, alpha}}, {1e-6, 1e-6, 0.0, 0.0, 0.0}, Base::per_lobe};
        test::Directions pairs;
        for (const double z : {1e-3, 1e-4, 1e-5}) pairs.add({0.0, 0.6, 0.8}, oracle::normalised({1.0, 0.0, z}));
        const std::vector<double> closed = eval(s, pairs, 0);
        for (const int order : {1, 2, 3, 8})
            EXPECT_LT(relrmse(eval(s, pairs, order), closed), 5e-3) << "alpha " << alpha << ", order " << order;
    }
}

TEST(WideningOrders, NumbersEverywhere) {
    test::Random random(11);
    const std::vector<double> alphas{0.0, 1e-6, 1e-3, 0.1, 1.0, 10.0}, rhos{-0.99, 0.0, 0.99};
    const std::vector<double> slopes{-2.0, 0.0, 0.5, 2.0}, lobes{1e-4, 0.01, 0.3, 3.0, 20.0};
    const std::array<smx_context, 4> contexts{context_of(1), context_of(4), context_of(8), context_of(16)};
    for (int number = 0; number < 240; ++number) {
        Scenery s;
        s.lobes = {{0.5, lobes[random.below(5)]}, {0.5, lobes[random.below(5)]}};
        s.x = {alphas[random.below(6)], alphas[random.below(6)], rhos[random.below(3)], slopes[random.below(4)],
               slopes[random.below(4)]};
        s.base = number % 2 ? Base::shared : Base::per_lobe;
        s.masking = number % 3 ? SMX_G2_CORRELATED : SMX_G2_SEPARABLE;
        test::Directions pairs;
        for (int k = 0; k < 40; ++k) {
            const Vec wi = random.direction(), wo = random.direction();
            const double grazing = random.log_uniform(1e-4, 1.0);
            const Vec low = oracle::spherical(std::acos(grazing), random.uniform(0.0, 2.0 * oracle::pi));
            pairs.add(k % 2 ? low : wi, k % 4 == 0 ? wi : k % 4 == 1 ? low : wo);
        }
        pairs.add({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
        for (const int order : {1, 2, 3, 5, 8}) {
            const std::vector<double> values =
                eval(s, pairs, order, SMX_GRADE_PRECISE, contexts[static_cast<std::size_t>(number) % 4]);
            for (std::size_t k = 0; k < values.size(); ++k)
                ASSERT_TRUE(std::isfinite(values[k]) && values[k] >= 0.0)
                    << values[k] << ": order " << order << ", lobes " << s.lobes[0].alpha << " " << s.lobes[1].alpha
                    << ", X " << s.x.alpha_x << " " << s.x.alpha_y << " rho " << s.x.rho << " mean " << s.x.mean_slope_x
                    << " " << s.x.mean_slope_y << ", wi.z " << pairs.wi[3 * k + 2] << ", wo.z " << pairs.wo[3 * k + 2];
        }
    }
}

TEST(WideningOrders, GradesAgree) {
    if (!test::has_double()) GTEST_SKIP() << "the device has no doubles";
    test::Random random(12);
    const Class c{"grades", {1e-3, 2.0}, {0.05, 0.5}, 1.0, Half::within_lobes, 0.0};
    double precise = 0.0, fast = 0.0;
    for (int number = 0; number < 8; ++number) {
        const Scenery s = random_scenery(c, random, number);
        const test::Directions pairs = make_pairs(s, Half::within_lobes, random, 64);
        for (const int order : {1, 3, 8}) {
            const std::vector<double> wanted = eval(s, pairs, order, SMX_GRADE_DOUBLE);
            precise = std::max(precise, relrmse(eval(s, pairs, order), wanted));
            fast = std::max(fast, relrmse(eval(s, pairs, order, SMX_GRADE_FAST), wanted));
        }
    }
    EXPECT_LT(precise, 1e-4);
    EXPECT_LT(fast, 5e-3);
    RecordProperty("precise", std::to_string(precise));
    RecordProperty("fast", std::to_string(fast));
}

// The azimuth of a half vector means nothing at the pole, whatever X's axes are.
TEST(WideningOrders, ContinuousAtThePole) {
    for (const smx_displacement &x : {smx_displacement{0.5, 0.1, 0.7, 0.0, 0.0},
                                      {0.3, 0.3, 0.0, 0.0, 0.0},
                                      {0.4, 0.0, 0.0, 0.0, 0.0},
                                      {0.5, 0.2, -0.4, 0.3, 0.2}})
        for (const double alpha : {0.05, 0.5, 2.0})
            for (const int order : {1, 2, 3, 8}) {
                test::Directions pairs;
                const Vec wi = oracle::spherical(0.6, 0.4);
                for (int k = 0; k < 64; ++k)
                    pairs.add(wi, oracle::reflect(wi, oracle::spherical(1e-6, k * oracle::pi / 32.0)));
                const std::vector<double> values = eval({{{1.0, alpha}}, x}, pairs, order);
                const auto [least, most] = std::minmax_element(values.begin(), values.end());
                EXPECT_LT(*most - *least, 1e-3 * *most)
                    << "alpha " << alpha << ", order " << order << ", X " << x.alpha_x << " " << x.alpha_y;
            }
}

TEST(WideningOrders, ContinuousInX) {
    test::Random random(13);
    Scenery s{{{1.0, 0.2}}, {0.3, 0.0, 0.0, 0.1, -0.2}};
    const test::Directions pairs = make_pairs(s, Half::within_lobes, random, 40);
    for (const int order : {1, 2, 3, 5, 8}) {
        // A second axis that vanishes. On a line the nodes are placed a little differently, order 1's most.
        s.x = {0.3, 0.0, 0.0, 0.1, -0.2};
        const std::vector<double> line = eval(s, pairs, order);
        const double jump = order == 1 ? 5e-3 : order == 2 ? 5e-4 : 1e-4;
        for (const double alpha : {1e-3, 1e-4, 1e-5}) {
            s.x.alpha_y = alpha;
            EXPECT_LT(relrmse(eval(s, pairs, order), line), jump + alpha) << "order " << order << ", alpha_y " << alpha;
        }
    }
}

// At equal alphas the principal axes change places, and the nodes with them: a jump within the order's own error.
TEST(WideningOrders, AxesChangePlacesWithinTheError) {
    test::Random random(14);
    Scenery s{{{1.0, 0.2}}, {0.3, 0.3, 0.0, 0.1, -0.2}};
    const test::Directions pairs = make_pairs(s, Half::within_lobes, random, 40);
    const std::vector<double> wanted = exact(s, pairs);
    for (const int order : {0, 1, 2, 3, 5, 8}) {
        s.x.alpha_y = 0.3 * (1.0 - 1e-5);
        const std::vector<double> before = eval(s, pairs, order);
        s.x.alpha_y = 0.3 * (1.0 + 1e-5);
        const std::vector<double> after = eval(s, pairs, order);
        const double error = std::max(relrmse(before, wanted), relrmse(after, wanted));
        EXPECT_LT(relrmse(after, before), 2.0 * error + 1e-4) << "order " << order;
        RecordProperty("jump_" + std::to_string(order), std::to_string(relrmse(after, before)));
        RecordProperty("error_" + std::to_string(order), std::to_string(error));
    }
}

namespace {

test::Image render(smx_material material, const smx_scene &scene, int order, smx_render_report *report = nullptr,
                   double tolerance = 0.02) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.widening_order = order;
    options.widening_tolerance = tolerance;
    test::Image image;
    EXPECT_SMX_OK(smx_render_filtered(test::context(), material, &scene, &options, image.out(), report));
    return image;
}

} // namespace

// The few pixels that auto looks at tell an image's error in 95 % of cases, and in the others nearly.
TEST(WideningOrders, AutoIsWithinItsTolerance) {
    const std::vector<test::Colour> colours{{0.1, 0.2, 0.3}, {0.3, 0.2, 0.1}};
    int cases = 0, within = 0;
    for (const auto &lobes :
         std::vector<std::vector<Lobe>>{{{1.0, 0.01}, {1.0, 0.3}}, {{1.0, 0.1}, {1.0, 0.5}}, {{1.0, 0.4}, {1.0, 1.5}}})
        for (const double light : {90.0, 0.0, -25.0})
            for (const double tolerance : {0.05, 0.02, 0.005}) {
                const test::Material material = test::make_per_lobe_material(lobes, colours);
                const smx_scene scene = test::make_scene(64, 64, test::radians(light), {0.4, 0.4, 0.0, 0.0, 0.0});
                smx_render_report report = SMX_RENDER_REPORT_INIT;
                const test::Image chosen = render(material, scene, SMX_WIDENING_AUTO, &report, tolerance);
                const double error = test::relrmse(chosen, render(material, scene, 8));
                const int first = report.widening_orders[0], second = report.widening_orders[1];
                ++cases, within += error <= tolerance;
                EXPECT_LT(error, 1.3 * tolerance) << "alpha " << lobes[0].alpha << ", light " << light;
                EXPECT_LT(first + second, 16) << "the most is not a choice";
                if (tolerance < 0.01) {
                    EXPECT_GT(first + second, 0);
                }
                EXPECT_EQ(report.widening_orders[2], 0);
                EXPECT_STREQ(smx_image_get_attribute(chosen, "slopemix.widening_order"), "auto");
                EXPECT_EQ(smx_image_get_attribute(chosen, "slopemix.widening_orders"),
                          std::to_string(first) + ',' + std::to_string(second));
            }
    EXPECT_GE(within, 0.95 * cases);
}

// The same of the shared model, on a line, and of more lobes than work-items.
TEST(WideningOrders, AutoOfOtherModels) {
    const std::vector<Lobe> lobes{{0.3, 0.05}, {0.1, 0.1}, {0.1, 0.2}, {0.2, 0.3}, {0.3, 0.9}};
    const test::Material material = test::make_material(lobes);
    for (const smx_displacement &x : {smx_displacement{0.4, 0.0, 0.0, 0.0, 0.0}, {0.5, 0.2, 0.6, 0.2, 0.1}}) {
        const smx_scene scene = test::make_scene(64, 48, 0.2, x, SMX_G2_SEPARABLE);
        const test::Image chosen = render(material, scene, SMX_WIDENING_AUTO);
        EXPECT_LT(test::relrmse(chosen, render(material, scene, 8)), 0.02) << "alpha_y " << x.alpha_y;
        // The choice is the same every time.
        const test::Image again = render(material, scene, SMX_WIDENING_AUTO);
        EXPECT_EQ(std::memcmp(smx_image_pixels(chosen), smx_image_pixels(again), sizeof(float) * 4 * 64 * 48), 0);
    }
}

TEST(WideningOrders, ReportsAndAttributesSayWhich) {
    const test::Material material = test::make_material({{0.5, 0.1}, {0.5, 0.5}});
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    const smx_scene smooth = test::make_scene(32, 32, 0.5, {}),
                    rough = test::make_scene(32, 32, 0.5, {0.3, 0.1, 0, 0, 0});
    test::Image image = render(material, smooth, SMX_WIDENING_AUTO, &report);
    EXPECT_EQ(report.widening_orders[0] + report.widening_orders[1], 0);
    image = render(material, rough, 3, &report);
    EXPECT_TRUE(report.widening_orders[0] == 3 && report.widening_orders[1] == 3 && report.widening_orders[2] == 0);
    EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.widening_orders"), "3,3");
    EXPECT_GE(report.unsettled, 0.0);
    EXPECT_LE(report.unsettled, 1.0);
}

// Order 0, and any order of a smooth X, is the closed form to the bit.
TEST(WideningOrders, ZerothIsTheClosedForm) {
    const test::Material material = test::make_material({{0.5, 0.1}, {0.5, 0.5}});
    for (const smx_displacement &x : {smx_displacement{}, {0.3, 0.1, 0.2, 0.1, 0.0}}) {
        const smx_scene scene = test::make_scene(33, 33, 0.5, x);
        const test::Image closed = test::render_filtered(material, scene);
        const test::Image other = render(material, scene, x.alpha_x > 0.0 ? 0 : 5);
        EXPECT_EQ(std::memcmp(smx_image_pixels(closed), smx_image_pixels(other), sizeof(float) * 4 * 33 * 33), 0);
        if (x.alpha_x > 0.0) {
            EXPECT_GT(test::relrmse(render(material, scene, 1), closed), 1e-3);
        }
    }
}
