// What `auto` leaves out of filtered images: over scenes drawn at random, hard ones included, never more than the
// tolerance; and it is not timid.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "random.h"
#include "support.h"

namespace {

constexpr int scenes = 220;

struct Case {
    test::Material material;
    smx_scene scene;
    smx_render_options options;
};

std::vector<oracle::Lobe> lobes(test::Random &random) {
    std::vector<oracle::Lobe> made(std::size_t{1} << random.below(4));
    for (oracle::Lobe &lobe : made)
        lobe = {random.log_uniform(1e-4, 1.0), random.log_uniform(random.below(4) ? 0.02 : 2e-4, 1.5)};
    return made;
}

// Curves from steep, as of a dielectric, to none, some lobes 1e-4 as strong as others.
std::vector<double> curves(test::Random &random, std::size_t sets) {
    constexpr std::size_t knots = 5;
    const double slope = random.below(3) ? random.log_uniform(1e-4, 1.0) : 0.0;
    const bool grey = random.below(2) == 0;
    std::vector<double> made;
    for (std::size_t set = 0; set < sets; ++set) {
        const double strength = random.log_uniform(1e-4, 1.0), shade = random.uniform();
        for (int channel = 0; channel < 3; ++channel) {
            const double f0 = strength * (grey ? shade : random.uniform());
            for (std::size_t k = 0; k < knots; ++k)
                made.push_back(f0 * (1.0 + slope * std::pow(static_cast<double>(k) / (knots - 1), 3)));
        }
    }
    return made;
}

smx_displacement displacement(test::Random &random) {
    const auto alpha = [&] { return random.below(5) ? random.log_uniform(1e-3, 1.5) : 0.0; };
    smx_displacement x = {alpha(), alpha(), 0.0, 0.0, 0.0};
    if (random.below(2)) x.alpha_y = x.alpha_x * (random.below(2) ? 1.0 : 1.0 + random.log_uniform(1e-5, 0.1));
    if (random.below(4) == 0) x.rho = random.uniform(-0.9, 0.9) * random.log_uniform(1e-3, 1.0);
    if (random.below(3) == 0) x.mean_slope_x = random.log_uniform(1e-6, 0.5);
    if (random.below(3) == 0) x.mean_slope_y = -random.log_uniform(1e-6, 0.5);
    return x;
}

Case draw(test::Random &random) {
    Case c;
    const std::vector<oracle::Lobe> drawn = lobes(random);
    const bool per_lobe = random.below(2) == 0;
    c.material = test::make_material(per_lobe ? SMX_MODEL_PER_LOBE : SMX_MODEL_SHARED, drawn,
                                     curves(random, per_lobe ? drawn.size() : 1), 5);
    const uint32_t sides[] = {12, 48, 64, 128};
    const uint32_t width = sides[random.below(4)], height = sides[random.below(4)];
    c.scene = test::make_scene(width, height, test::radians(random.uniform(-75.0, 90.0)), displacement(random),
                               random.below(5) ? SMX_G2_CORRELATED : SMX_G2_SEPARABLE);
    c.options = SMX_RENDER_OPTIONS_INIT;
    c.options.effect_tolerance = std::pow(10.0, -2.0 - static_cast<double>(random.below(3)));
    c.options.widening_order = random.below(8) ? 0 : 2;
    return c;
}

test::Image render(const Case &c, uint32_t effects, smx_render_report *report = nullptr) {
    smx_render_options options = c.options;
    options.effects = effects;
    test::Image image;
    EXPECT_SMX_OK(smx_render_filtered(test::context(), c.material, &c.scene, &options, image.out(), report));
    return image;
}

// Effects that the image would differ without, and that are left out.
int left_out_with_a_say(const Case &c) {
    smx_effect_report report = SMX_EFFECT_REPORT_INIT;
    EXPECT_SMX_OK(smx_material_effects(c.material, &c.scene, &c.options, &report));
    int count = 0;
    for (const smx_effect_verdict &v : report.verdicts) count += v.supported && !v.on && v.contribution > 0.0;
    return count;
}

double brightest(smx_image image) {
    const test::Pixels p = test::pixels(image);
    double most = 0.0;
    for (std::size_t n = 0; n < 4 * std::size_t{p.width} * p.height; ++n)
        if (n % 4 != 3) most = std::max(most, double{p.rgba[n]});
    return most;
}

std::string text_of(const Case &c) {
    const smx_displacement &x = c.scene.displacement;
    std::ostringstream out;
    out << c.scene.width << "x" << c.scene.height << ", light " << c.scene.light_phi << ", alpha " << x.alpha_x << " "
        << x.alpha_y << " rho " << x.rho << " mean " << x.mean_slope_x << " " << x.mean_slope_y << ", g "
        << c.scene.masking << ", tolerance " << c.options.effect_tolerance << ", order " << c.options.widening_order
        << ", lobes";
    for (const smx_lobe &lobe : test::lobes_of(c.material)) out << " " << lobe.alpha;
    return out.str();
}

} // namespace

TEST(EffectsAuto, LeavesOutWithinTheToleranceAndIsNotTimid) {
    test::Random random(20260);
    int judged = 0, left_out = 0, kept = 0, timid = 0;
    double largest = 0.0;
    for (int n = 0; n < scenes; ++n) {
        const Case c = draw(random);
        SCOPED_TRACE(::testing::Message() << "scene " << n << ": " << text_of(c));
        smx_render_report report = SMX_RENDER_REPORT_INIT, of_all = SMX_RENDER_REPORT_INIT;
        const test::Image all = render(c, SMX_EFFECTS_ALL, &of_all), chosen = render(c, SMX_EFFECTS_AUTO, &report);
        if (!(brightest(all) > 0.0)) {
            EXPECT_EQ(brightest(chosen), 0.0);
            continue;
        }
        ++judged;
        left_out += left_out_with_a_say(c);
        const double error = test::relrmse(chosen, all) / c.options.effect_tolerance;
        EXPECT_LE(error, 1.0) << "left out " << (of_all.effects & ~report.effects) << " and "
                              << of_all.lobes - report.lobes << " lobes";
        largest = std::max(largest, error);
        for (uint32_t effect = 1; effect < SMX_EFFECT_INTERREFLECTION; effect *= 2) {
            if (!(report.effects & effect)) continue;
            ++kept;
            const test::Image without = render(c, of_all.effects & ~effect);
            timid += test::relrmse(without, all) <= 0.1 * c.options.effect_tolerance;
        }
    }
    RecordProperty("largest_share_of_tolerance", std::to_string(largest));
    RecordProperty("timid_share", std::to_string(static_cast<double>(timid) / kept));
    std::printf("%d scenes, %d effects left out, %d kept, %d of these needlessly; at most %.2f of the tolerance\n",
                judged, left_out, kept, timid, largest);
    EXPECT_GE(judged, 200);
    EXPECT_GT(left_out, judged / 2); // of those that have a say
    EXPECT_LE(timid, 0.1 * kept);
}

TEST(EffectsAuto, GivesAVerdictWithAReasonOnEachEffect) {
    const test::Material material = test::make_material({{1.0, 0.1}}, {0.9, 0.8, 0.7});
    const smx_scene scene = test::make_scene(128, 128, -0.9, {0.5, 0.5, 0.0, 0.0, 0.0});
    smx_effect_report report = SMX_EFFECT_REPORT_INIT;
    ASSERT_SMX_OK(smx_material_effects(material, &scene, nullptr, &report));
    const auto verdict = [&](smx_effect effect) -> const smx_effect_verdict & {
        return report.verdicts[std::countr_zero(static_cast<unsigned>(effect))];
    };
    for (const smx_effect_verdict &v : report.verdicts) {
        EXPECT_EQ(verdict(v.effect).effect, v.effect);
        EXPECT_NE(v.reason[0], '\0');
        EXPECT_EQ(v.supported, v.effect != SMX_EFFECT_INTERREFLECTION);
    }
    for (const smx_effect on : {SMX_EFFECT_MASKING, SMX_EFFECT_SHADOWING, SMX_EFFECT_HEIGHT_CORRELATION}) {
        EXPECT_TRUE(verdict(on).on);
        EXPECT_GT(verdict(on).contribution, 5e-4);
    }
    for (const smx_effect off :
         {SMX_EFFECT_FRESNEL, SMX_EFFECT_LOBE_COLOR, SMX_EFFECT_ANISOTROPY, SMX_EFFECT_MEAN_SLOPE}) {
        EXPECT_FALSE(verdict(off).on);
        EXPECT_EQ(verdict(off).contribution, 0.0);
    }
    EXPECT_STREQ(verdict(SMX_EFFECT_ANISOTROPY).reason, "alpha is 0.5 along both axes");
    EXPECT_EQ(report.left_out, 0.0);
    EXPECT_EQ(report.lobes, 1u);
}

TEST(EffectsAuto, VerdictsSayWhatIsRendered) {
    const test::Material material = test::make_material({{1.0, 0.1}});
    const smx_scene scene = test::make_scene(48, 48, 0.3, {0.25, 0.25, 0.0, 0.0, 0.0});
    for (const uint32_t effects :
         {SMX_EFFECTS_AUTO, SMX_EFFECTS_ALL, SMX_EFFECTS_NONE,
          uint32_t{SMX_EFFECT_MASKING | SMX_EFFECT_HEIGHT_CORRELATION | SMX_EFFECT_ANISOTROPY}}) {
        smx_render_options options = SMX_RENDER_OPTIONS_INIT;
        options.effects = effects;
        smx_effect_report judged = SMX_EFFECT_REPORT_INIT;
        ASSERT_SMX_OK(smx_material_effects(material, &scene, &options, &judged));
        uint32_t on = 0;
        for (const smx_effect_verdict &v : judged.verdicts)
            if (v.on) on |= v.effect;
        test::Image image;
        smx_render_report report = SMX_RENDER_REPORT_INIT;
        ASSERT_SMX_OK(smx_render_filtered(test::context(), material, &scene, &options, image.out(), &report));
        EXPECT_EQ(on, report.effects) << effects;
    }
}

TEST(EffectsAuto, DropsLobesThatAddNothing) {
    const test::Material material =
        test::make_per_lobe_material({{1.0, 0.1}, {1.0, 0.4}}, {{0.9, 0.9, 0.9}, {1e-7, 1e-7, 1e-7}});
    const smx_scene scene = test::make_scene(64, 64, 0.3, {0.25, 0.25, 0.0, 0.0, 0.0});
    smx_effect_report report = SMX_EFFECT_REPORT_INIT;
    ASSERT_SMX_OK(smx_material_effects(material, &scene, nullptr, &report));
    EXPECT_EQ(report.lobes, 1u);
    EXPECT_TRUE(report.shaded[0] == 1 && report.shaded[1] == 0);
    EXPECT_GT(report.left_out, 0.0);
    EXPECT_LT(report.left_out, 1e-3);
}

TEST(EffectsAuto, KeepsAllOfABlackImage) {
    const test::Material material = test::make_material({{1.0, 0.1}});
    const smx_scene scene = test::make_scene(32, 32, -oracle::pi / 2, {0.25, 0.25, 0.0, 0.0, 0.0});
    smx_effect_report report = SMX_EFFECT_REPORT_INIT;
    ASSERT_SMX_OK(smx_material_effects(material, &scene, nullptr, &report));
    for (const smx_effect_verdict &v : report.verdicts) EXPECT_EQ(v.on, v.supported);
}

TEST(EffectsAuto, RefusesWhatItCannotJudge) {
    const test::Material material = test::make_material({{1.0, 0.1}});
    smx_scene scene = test::make_scene(32, 32, 0.0, {0.25, 0.25, 0.0, 0.0, 0.0});
    smx_effect_report report = SMX_EFFECT_REPORT_INIT;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "material is null", smx_material_effects(nullptr, &scene, nullptr, &report));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "scene is null", smx_material_effects(material, nullptr, nullptr, &report));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "report is null", smx_material_effects(material, &scene, nullptr, nullptr));
    report.size = 4;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "report->size", smx_material_effects(material, &scene, nullptr, &report));
    report.size = sizeof report;
    scene.displacement.alpha_x = -1.0;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "alpha_x", smx_material_effects(material, &scene, nullptr, &report));
}
