// Effects by name: what is left out is what docs/effects.md says, in images and for pairs of directions; what cannot be
// is refused.
#include <gtest/gtest.h>

#include <functional>

#include "close.h"
#include "directions.h"
#include "oracle_sphere.h"
#include "random.h"
#include "support.h"

using oracle::Mixture;
using oracle::Vec;

namespace {

constexpr uint32_t every_effect = SMX_EFFECT_MASKING | SMX_EFFECT_SHADOWING | SMX_EFFECT_HEIGHT_CORRELATION |
                                  SMX_EFFECT_FRESNEL | SMX_EFFECT_LOBE_COLOR | SMX_EFFECT_ANISOTROPY |
                                  SMX_EFFECT_MEAN_SLOPE;
constexpr double float_tolerance = 2e-5;
const std::vector<oracle::Lobe> lobes = {{0.4, 0.1}, {0.6, 0.5}};
constexpr smx_displacement tilted_lines = {0.4, 0.1, 0.3, 0.2, -0.1};

smx_render_options with_effects(uint32_t effects) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = effects;
    return options;
}

// Directions that are above the mean planes of both the tilted surface and the level one.
test::Directions directions(std::size_t count) {
    test::Random random(61);
    test::Directions d;
    while (d.count() < count) {
        const Vec wi = random.direction(0.05), wo = random.direction(0.05);
        const oracle::Gaussian x = test::gaussian(tilted_lines);
        if (plane(x, wi) > 0.02 && plane(x, wo) > 0.02) d.add(wi, wo);
    }
    return d;
}

std::vector<float> eval(smx_material material, const smx_displacement &x, uint32_t effects, const test::Directions &d,
                        smx_masking masking = SMX_G2_CORRELATED) {
    const smx_render_options options = with_effects(effects);
    std::vector<float> fcos(d.wi.size());
    EXPECT_SMX_OK(smx_material_eval(test::context(), material, &x, masking, &options, d.count(), d.wi.data(),
                                    d.wo.data(), fcos.data()));
    return fcos;
}

void expect_close(const std::vector<float> &got, const std::vector<float> &wanted) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t n = 0; n < got.size(); ++n)
        ASSERT_TRUE(test::is_close(got[n], wanted[n], float_tolerance, 1e-12))
            << "number " << n << ": " << got[n] << ", wanted " << wanted[n];
}

// Red of the shared model with one curve of 1, from G2 / plane(wo).
void expect_masked(uint32_t effects, const std::function<double(const Mixture &, const Vec &, const Vec &)> &g2) {
    const test::Material material = test::make_material(lobes);
    const test::Directions d = directions(200);
    const std::vector<float> fcos = eval(material, tilted_lines, effects, d);
    const Mixture m{lobes, test::gaussian(tilted_lines)};
    for (std::size_t k = 0; k < d.count(); ++k) {
        const Vec wi = test::Directions::at(d.wi, k), wo = test::Directions::at(d.wo, k);
        const double wanted = ndf(m, half_vector(wi, wo)) * g2(m, wi, wo) / (4.0 * plane(m.x, wo));
        ASSERT_TRUE(test::is_close(fcos[3 * k], wanted, float_tolerance, 1e-12))
            << "pair " << k << ": " << fcos[3 * k] << ", wanted " << wanted;
    }
}

double g1(const Mixture &m, const Vec &k) { return plane(m.x, k) / sigma(m, k); }

} // namespace

TEST(Effects, MaskingAndShadowingAreSmithsFromOneSideEach) {
    const uint32_t neither = every_effect & ~(SMX_EFFECT_MASKING | SMX_EFFECT_SHADOWING);
    expect_masked(neither, [](const Mixture &, const Vec &, const Vec &) { return 1.0; });
    expect_masked(neither | SMX_EFFECT_MASKING, [](const Mixture &m, const Vec &, const Vec &wo) { return g1(m, wo); });
    expect_masked(neither | SMX_EFFECT_SHADOWING,
                  [](const Mixture &m, const Vec &wi, const Vec &) { return g1(m, wi); });
    expect_masked(every_effect & ~SMX_EFFECT_HEIGHT_CORRELATION,
                  [](const Mixture &m, const Vec &wi, const Vec &wo) { return g1(m, wi) * g1(m, wo); });
}

TEST(Effects, FresnelIsTheCurvesOverTheDifferenceAngle) {
    // Of two knots: 0.2, 0.4, 0.6 at 0 and 1 at 90 degrees.
    const test::Material curved = test::make_material(SMX_MODEL_SHARED, lobes, {0.2, 1.0, 0.4, 1.0, 0.6, 1.0}, 2);
    const test::Material flat = test::make_material(lobes, {0.2, 0.4, 0.6});
    const test::Directions d = directions(100);
    expect_close(eval(curved, tilted_lines, every_effect & ~SMX_EFFECT_FRESNEL, d),
                 eval(flat, tilted_lines, every_effect, d));
}

TEST(Effects, LobeColorIsTheLobesOwnCurves) {
    const std::vector<test::Colour> colours = {{0.1, 0.2, 0.3}, {0.6, 0.2, 0.4}};
    const test::Material per_lobe = test::make_per_lobe_material(lobes, colours);
    // Constant curves: a lobe's energy is the mean of its colours.
    const test::Material one_curve =
        test::make_material({{0.2, lobes[0].alpha}, {0.4, lobes[1].alpha}}, {0.7, 0.4, 0.7});
    const test::Directions d = directions(100);
    expect_close(eval(per_lobe, tilted_lines, every_effect & ~SMX_EFFECT_LOBE_COLOR, d),
                 eval(one_curve, tilted_lines, every_effect, d));
}

TEST(Effects, AnisotropyAndMeanSlopeAreTheSurfaces) {
    const test::Material material = test::make_material(lobes);
    const test::Directions d = directions(100);
    smx_displacement isotropic = tilted_lines, level = tilted_lines;
    isotropic.alpha_x = isotropic.alpha_y = std::sqrt((0.4 * 0.4 + 0.1 * 0.1) / 2);
    isotropic.rho = 0.0;
    level.mean_slope_x = level.mean_slope_y = 0.0;
    expect_close(eval(material, tilted_lines, every_effect & ~SMX_EFFECT_ANISOTROPY, d),
                 eval(material, isotropic, every_effect, d));
    expect_close(eval(material, tilted_lines, every_effect & ~SMX_EFFECT_MEAN_SLOPE, d),
                 eval(material, level, every_effect, d));
}

TEST(Effects, ImagesLeaveOutWhatPairsDo) {
    const test::Material material = test::make_per_lobe_material(lobes, {{0.1, 0.2, 0.3}, {0.6, 0.2, 0.4}});
    smx_displacement level = tilted_lines;
    level.mean_slope_x = level.mean_slope_y = 0.0;
    for (const int32_t order : {0, 2}) {
        smx_render_options without = with_effects(every_effect & ~SMX_EFFECT_MEAN_SLOPE);
        smx_render_options all = with_effects(SMX_EFFECTS_ALL);
        without.widening_order = all.widening_order = order;
        const smx_scene tilted = test::make_scene(33, 33, 0.3, tilted_lines),
                        flat = test::make_scene(33, 33, 0.3, level);
        test::Image got, wanted;
        smx_render_report report = SMX_RENDER_REPORT_INIT;
        ASSERT_SMX_OK(smx_render_filtered(test::context(), material, &tilted, &without, got.out(), &report));
        EXPECT_EQ(report.effects, without.effects);
        EXPECT_EQ(report.lobes, 2u);
        ASSERT_SMX_OK(smx_render_filtered(test::context(), material, &flat, &all, wanted.out(), &report));
        EXPECT_EQ(report.effects, every_effect);
        EXPECT_LT(test::relrmse(got, wanted), float_tolerance) << "order " << order;
        EXPECT_STREQ(smx_image_get_attribute(got, "slopemix.effects"),
                     "masking,shadowing,height-correlation,fresnel,lobe-color,anisotropy");
    }
}

TEST(Effects, ReferenceWithoutMaskingIsTheFilterWithout) {
    // Of a base this narrow on a surface this smooth the closed form is the reference.
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.2}}, oracle::Masking::correlated));
    const smx_scene scene = test::make_scene(33, 33, 1.2, {0.05, 0.05, 0.0, 0.0, 0.0});
    smx_render_options options = with_effects(SMX_EFFECTS_ALL);
    options.spp = 4096;
    test::Image all, none;
    ASSERT_SMX_OK(smx_render_reference(test::context(), brdf, &scene, &options, all.out(), nullptr));
    options.effects = SMX_EFFECT_ANISOTROPY | SMX_EFFECT_MEAN_SLOPE;
    ASSERT_SMX_OK(smx_render_reference(test::context(), brdf, &scene, &options, none.out(), nullptr));
    // G2 is below 1, and nowhere else do they differ.
    const test::Pixels with = test::pixels(all), without = test::pixels(none);
    const oracle::Gaussian x = test::gaussian(scene.displacement);
    for (uint32_t row = 0; row < 33; ++row)
        for (uint32_t column = 0; column < 33; ++column) {
            const oracle::Pixel p = oracle::sphere_pixel(33, 33, column, row, scene.light_phi);
            if (!p.on_sphere || p.wi.z <= 0.0) continue;
            const double g2 = oracle::g2(oracle::Masking::correlated, x, p.wi, p.wo);
            ASSERT_TRUE(test::is_close(with.at(column, row)[0], g2 * without.at(column, row)[0], 1e-4, 1e-9));
        }
}

TEST(Effects, RefusesWhatAnIntegratorDoesNotSimulate) {
    const test::Material material = test::make_material(lobes);
    const test::Brdf brdf = test::make_brdf(test::beckmann_table(lobes, oracle::Masking::correlated));
    smx_scene scene = test::make_scene(16, 16, 0.3, tilted_lines);
    test::Image image;
    smx_render_options options = with_effects(SMX_EFFECT_MASKING | SMX_EFFECT_INTERREFLECTION);
    const auto filtered = [&] {
        return smx_render_filtered(test::context(), material, &scene, &options, image.out(), nullptr);
    };
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "interreflection", filtered());
    options.effects = 256;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "effects is 256", filtered());
    options.effects = SMX_EFFECTS_AUTO | SMX_EFFECT_MASKING;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "effects is", filtered());
    options.effects = SMX_EFFECTS_AUTO;
    for (const double tolerance : {-1e-9, 1.0, std::nan("")}) {
        options.effect_tolerance = tolerance;
        EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "effect_tolerance", filtered());
    }
    options = with_effects(every_effect);
    scene.masking = SMX_G2_SEPARABLE;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "separable", filtered());
    scene.masking = SMX_G2_CORRELATED;

    options = with_effects(SMX_EFFECT_FRESNEL);
    options.spp = 64;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "fresnel",
                     smx_render_reference(test::context(), brdf, &scene, &options, image.out(), nullptr));
    options.effects = SMX_EFFECT_HEIGHT_CORRELATION;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "height-correlation",
                     smx_render_geometric(test::context(), brdf, &scene, &options, nullptr, image.out(), nullptr));
    options.effects = SMX_EFFECT_INTERREFLECTION;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "bounces is 0",
                     smx_render_geometric(test::context(), brdf, &scene, &options, nullptr, image.out(), nullptr));
}

TEST(Effects, HaveNames) {
    EXPECT_STREQ(smx_effect_name(SMX_EFFECT_MASKING), "masking");
    EXPECT_STREQ(smx_effect_name(SMX_EFFECT_INTERREFLECTION), "interreflection");
    EXPECT_EQ(smx_effect_name(static_cast<smx_effect>(3)), nullptr);
}

// What is left without any effect is as exact as a float is, up to grazing directions: the slope's square stands in an
// exponent of up to 80.
TEST(Effects, NoneIsExactUpToGrazing) {
    if (!test::has_double()) GTEST_SKIP() << "no double on the device";
    constexpr double exponent_tolerance = 5e-5, lost = 1e-30; // of a density below exp(-69)
    test::Random random(11);
    std::vector<float> wi, wo;
    for (int pair = 0; pair < 50000; ++pair)
        for (std::vector<float> *k : {&wi, &wo}) {
            const double z = random.log_uniform(1e-7, 1.0), phi = random.uniform(0.0, 2.0 * oracle::pi);
            const double r = std::sqrt(1.0 - z * z);
            for (const double c : {r * std::cos(phi), r * std::sin(phi), z}) k->push_back(static_cast<float>(c));
        }
    for (const double alpha : {1e-2, 0.2, 10.0, 1e4}) {
        const test::Material material = test::make_material({{1.0, alpha}});
        smx_render_options options = SMX_RENDER_OPTIONS_INIT;
        options.effects = SMX_EFFECTS_NONE;
        const smx_displacement x{0.1, 0.1, 0.0, 0.0, 0.0};
        std::vector<float> precise(wi.size()), exact(wi.size());
        ASSERT_SMX_OK(smx_material_eval(test::context(), material, &x, SMX_G2_CORRELATED, &options, wi.size() / 3,
                                        wi.data(), wo.data(), precise.data()));
        options.grade = SMX_GRADE_DOUBLE;
        ASSERT_SMX_OK(smx_material_eval(test::context(), material, &x, SMX_G2_CORRELATED, &options, wi.size() / 3,
                                        wi.data(), wo.data(), exact.data()));
        double worst = 0.0, seen = 0.0;
        for (std::size_t k = 0; k < exact.size(); ++k) {
            if (!(exact[k] > lost)) continue;
            worst = std::max(worst, std::abs(double{precise[k]} - exact[k]) / exact[k]);
            ++seen;
        }
        EXPECT_LT(worst, exponent_tolerance) << "alpha " << alpha;
        EXPECT_GT(seen, 1000.0) << "alpha " << alpha;
    }
}
