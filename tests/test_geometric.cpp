// The geometric reference: against the statistical one where they ask the same, in a white furnace, and its switches.
#include <gtest/gtest.h>

#include <bit>
#include <functional>

#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "support.h"
#include "tile_facets.h"

namespace {

struct Geometric {
    test::Image image;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    const float *pixels() const { return smx_image_pixels(image); }
    const float *errors() const { return smx_image_errors(image); }
};

struct Settings {
    smx_scene scene = SMX_SCENE_INIT;
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    smx_geometric_options geometric = SMX_GEOMETRIC_OPTIONS_INIT;

    Settings(uint32_t size, double alpha, uint32_t realisations, uint32_t samples) {
        scene.width = scene.height = size;
        scene.light_phi = test::radians(60.0);
        scene.displacement = {alpha, alpha, 0.0, 0.0, 0.0};
        options.spp = realisations * samples;
        options.errors = 1;
        geometric.realisations = realisations;
        geometric.tile = 512;
    }
};

Geometric render(smx_brdf brdf, const Settings &s, smx_context where = nullptr) {
    Geometric g;
    EXPECT_SMX_OK(smx_render_geometric(where ? where : test::context(), brdf, &s.scene, &s.options, &s.geometric,
                                       g.image.out(), &g.report));
    return g;
}

test::Brdf open(const char *name) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_brdf_open(name, brdf.out()));
    return brdf;
}

// Mean of the red channel over the sphere.
double mean(const Geometric &g, const Settings &s) {
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < std::size_t{s.scene.width} * s.scene.height; ++k)
        if (g.pixels()[4 * k + 3] > 0.0f) sum += g.pixels()[4 * k], ++count;
    return sum / count;
}

// A surface whose facets nothing hides.
constexpr uint32_t unhidden = SMX_EFFECT_ANISOTROPY | SMX_EFFECT_MEAN_SLOPE;

// Red of the statistical reference without masking and shadowing.
std::vector<double> unmasked_reference(smx_brdf brdf, const smx_scene &scene) {
    smx_render_options options = test::make_options(65536);
    options.effects = unhidden;
    const test::Image image = test::render_reference(brdf, scene, options);
    std::vector<double> red;
    for (std::size_t k = 0; k < std::size_t{scene.width} * scene.height; ++k)
        red.push_back(smx_image_pixels(image)[4 * k]);
    return red;
}

// The scene with the slopes that the tiles of these realisations have, which is what its pixels are to tell of.
smx_scene as_measured(const Settings &s) {
    const smx_displacement &x = s.scene.displacement;
    const smx::Displacement m = test::measured({x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y},
                                               static_cast<std::uint32_t>(std::countr_zero(s.geometric.tile)),
                                               s.options.seed, s.geometric.realisations);
    smx_scene scene = s.scene;
    scene.displacement = {m.alpha_x, m.alpha_y, m.rho, m.mean_slope_x, m.mean_slope_y};
    return scene;
}

// Share of the lit pixels whose difference is beyond `limit` standard errors.
double share_beyond(const Geometric &g, const std::vector<double> &wanted, double limit) {
    double beyond = 0.0, count = 0.0;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (wanted[k] <= 0.0) continue;
        beyond += std::abs(g.pixels()[4 * k] - wanted[k]) > limit * g.errors()[4 * k];
        ++count;
    }
    EXPECT_GT(count, 100.0);
    return beyond / count;
}

// Of Student's t with 31 degrees of freedom: 5 % lie beyond.
constexpr uint32_t realisations = 32;
constexpr double t_5_percent = 2.0395;
// Some 190 pixels see the same tiles, and are as good as 50 that do not: three seeds tell 5 % +- 1.8 %, and this is
// three of these. (Over ten seeds of 256 samples the means were 5.6, 7.5 and 5.3 % for the three surfaces: on the
// second, where little is lit, few bright samples make a mean of 32 lean.)
constexpr uint64_t seeds = 3;
constexpr double most_beyond = 0.105;
// Of a surface that is a twentieth too rough, 79 to 84 % were.
constexpr double least_beyond = 0.6;

} // namespace

// What one ray sees of a smooth surface, all see.
TEST(Geometric, SmoothSurfaceIsTheTable) {
    const test::Brdf brdf = open("builtin:conductor");
    const Settings s(16, 0.0, 2, 16);
    const Geometric g = render(brdf, s);
    EXPECT_LT(g.report.standard_error, 1e-6);
    EXPECT_LT(test::relrmse(g.image, test::render_reference(brdf, s.scene, test::make_options(1))), 1e-5);
}

TEST(Geometric, WithoutMaskingAndShadowingIsTheStatisticalReferenceWithoutThem) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.4}}, oracle::Masking::correlated));
    for (const smx_displacement &x :
         {smx_displacement{0.25, 0.25, 0.0, 0.0, 0.0}, {0.4, 0.1, 0.5, 0.0, 0.0}, {0.0, 0.3, 0.0, 0.1, 0.0}}) {
        Settings s(16, 0.0, realisations, 512);
        s.scene.displacement = x;
        s.options.effects = unhidden;
        double beyond = 0.0, beyond_too_rough = 0.0;
        for (s.options.seed = 0; s.options.seed < seeds; ++s.options.seed) {
            const Geometric g = render(brdf, s);
            smx_scene scene = as_measured(s);
            beyond += share_beyond(g, unmasked_reference(brdf, scene), t_5_percent) / seeds;
            scene.displacement.alpha_x *= 1.05;
            scene.displacement.alpha_y *= 1.05;
            beyond_too_rough += share_beyond(g, unmasked_reference(brdf, scene), t_5_percent) / seeds;
        }
        std::printf("X %g %g: %.1f %% beyond, %.1f %% of a surface that is too rough\n", x.alpha_x, x.alpha_y,
                    100.0 * beyond, 100.0 * beyond_too_rough);
        EXPECT_LT(beyond, most_beyond) << "X " << x.alpha_x << " " << x.alpha_y;
        EXPECT_GT(beyond_too_rough, least_beyond) << "X " << x.alpha_x << " " << x.alpha_y;
    }
}

// Smith's formula is a model of this surface: near it, and not the same. Error of the geometric image apart.
TEST(Geometric, IsNearTheStatisticalReference) {
    const test::Brdf brdf = open("builtin:conductor");
    const Settings s(24, 0.25, 16, 256);
    const Geometric g = render(brdf, s);
    const test::Image reference = test::render_reference(brdf, s.scene, test::make_options(65536));
    EXPECT_LT(g.report.standard_error, 0.06);
    EXPECT_LT(test::relrmse(g.image, reference), 0.08);
}

// Where the light is at the viewer, what is seen is lit: the ray to it is the ray that came. (Smith's formula takes a
// share there, and so is beneath.)
TEST(Geometric, WhatIsSeenFromTheLightIsLit) {
    const test::Brdf brdf = open("analytic:lambert,albedo=1");
    Settings s(16, 1.0, 4, 256);
    s.scene.light_phi = test::radians(90.0);
    const Geometric shadowed = render(brdf, s);
    s.options.effects = unhidden | SMX_EFFECT_MASKING;
    const Geometric unshadowed = render(brdf, s);
    // A ray that goes back along an edge that it just missed may meet it by rounding.
    EXPECT_LT(test::relrmse(shadowed.image, unshadowed.image), 1e-4);
    const test::Image smith = test::render_reference(brdf, s.scene, test::make_options(4096));
    double below = 0.0;
    for (std::size_t k = 0; k < std::size_t{4} * 16 * 16; k += 4)
        below += shadowed.pixels()[k] - smx_image_pixels(smith)[k];
    EXPECT_GT(below, 0.0);
}

// A furnace: no light is lost at facets that reflect all of it, once it may go on until it is out.
TEST(Geometric, WhiteFurnace) {
    constexpr double energy_tolerance = 0.005;
    for (const char *name : {"analytic:lambert,albedo=1", "builtin:mirror"}) {
        const test::Brdf brdf = open(name);
        for (const double alpha : {0.5, 1.0}) {
            Settings s(24, alpha, 16, 128);
            s.scene.light = SMX_LIGHT_UNIFORM;
            const double single = mean(render(brdf, s), s);
            s.geometric.bounces = 32;
            const Geometric all = render(brdf, s);
            EXPECT_NEAR(mean(all, s), 1.0, energy_tolerance) << name << ", alpha " << alpha;
            EXPECT_LT(single, 1.0 - 10.0 * energy_tolerance) << name << ", alpha " << alpha;
            RecordProperty(std::string("single_scatter_") + name + "_" + std::to_string(alpha), std::to_string(single));
        }
    }
}

// Each switch does what its name says, pixel by pixel in the mean.
TEST(Geometric, SwitchesAddAndTakeLight) {
    const test::Brdf brdf = open("analytic:lambert,albedo=1");
    Settings s(16, 1.0, 8, 64);
    const double single = mean(render(brdf, s), s);
    s.geometric.bounces = 1;
    const double twice = mean(render(brdf, s), s);
    s.geometric.bounces = 4;
    const double more = mean(render(brdf, s), s);
    s.geometric.bounces = 0;
    s.options.effects = unhidden | SMX_EFFECT_MASKING;
    const double unshadowed = mean(render(brdf, s), s);
    EXPECT_GT(twice, 1.02 * single);
    EXPECT_GT(more, 1.002 * twice);
    EXPECT_GT(unshadowed, 1.05 * single);
}

// Auto follows light further where that shows.
TEST(Geometric, AutoJudgesInterreflection) {
    const test::Brdf brdf = open("analytic:lambert,albedo=0.8");
    for (const double alpha : {0.02, 1.0}) {
        Settings s(16, alpha, 2, 64);
        s.options.effects = SMX_EFFECTS_AUTO;
        s.options.effect_tolerance = 0.01;
        s.geometric.bounces = 3;
        const Geometric chosen = render(brdf, s);
        EXPECT_EQ((chosen.report.effects & SMX_EFFECT_INTERREFLECTION) != 0, alpha == 1.0) << alpha;
        EXPECT_GE(chosen.report.interreflection, 0.0);
        s.options.effects = SMX_EFFECTS_ALL;
        const Geometric all = render(brdf, s);
        EXPECT_LT(all.report.interreflection, 0.0); // not judged
        // Left out it would be within the tolerance; kept it is the same image.
        EXPECT_LE(test::relrmse(chosen.image, all.image), s.options.effect_tolerance) << alpha;
        EXPECT_EQ(chosen.report.interreflection > 0.02, alpha == 1.0) << alpha;
    }
}

TEST(Geometric, SameBitsOnAnyNumberOfDevices) {
    const test::Brdf brdf = open("builtin:two-layer");
    Settings s(93, 0.5, 2, 20);
    s.scene.height = 71;
    s.geometric.bounces = 1;
    smx_context_options halves = SMX_CONTEXT_OPTIONS_INIT;
    halves.sub_devices = 2;
    test::Context two;
    ASSERT_SMX_OK(smx_context_create(&halves, two.out()));
    const Geometric a = render(brdf, s), b = render(brdf, s, two);
    s.options.seed = 1;
    const Geometric c = render(brdf, s);
    bool same = true, other = false;
    for (std::size_t k = 0; k < std::size_t{4} * s.scene.width * s.scene.height; ++k) {
        same = same && a.pixels()[k] == b.pixels()[k] && a.errors()[k] == b.errors()[k];
        other = other || a.pixels()[k] != c.pixels()[k];
    }
    EXPECT_TRUE(same);
    EXPECT_TRUE(other);
}

TEST(Geometric, OneRealisationHasNoError) {
    Settings s(8, 0.5, 1, 16);
    s.options.errors = 0;
    EXPECT_LT(render(open("builtin:conductor"), s).report.standard_error, 0.0);
}

namespace {

// A value that the compiler does not know to be none of the enumeration's.
template <class Enum>
Enum beyond() {
    volatile int value = 3;
    return static_cast<Enum>(value);
}

void expect_refused(const char *needle, const std::function<void(Settings &)> &change) {
    static const test::Brdf brdf = open("builtin:conductor");
    Settings s(8, 0.5, 4, 4);
    change(s);
    smx_image image = nullptr;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, needle,
                     smx_render_geometric(test::context(), brdf, &s.scene, &s.options, &s.geometric, &image, nullptr));
    EXPECT_EQ(image, nullptr);
}

} // namespace

TEST(Geometric, BadArgumentsAreRefused) {
    expect_refused("tile is 100", [](Settings &s) { s.geometric.tile = 100; });
    expect_refused("tile is 32", [](Settings &s) { s.geometric.tile = 32; });
    expect_refused("tile is 16384", [](Settings &s) { s.geometric.tile = 16384; });
    expect_refused("realisations is 0", [](Settings &s) { s.geometric.realisations = 0; });
    expect_refused("bounces is 1025", [](Settings &s) { s.geometric.bounces = 1025; });
    expect_refused("multiple of realisations, 4", [](Settings &s) { s.options.spp = 6; });
    expect_refused("spp is 0", [](Settings &s) { s.options.spp = 0; });
    expect_refused("target_error is 0.1", [](Settings &s) { s.options.target_error = 0.1; });
    expect_refused("errors need at least 2", [](Settings &s) { s.geometric.realisations = 1; });
    expect_refused("light is 3", [](Settings &s) { s.scene.light = beyond<smx_light>(); });
    expect_refused("geometric->size", [](Settings &s) { s.geometric.size = 1; });
    expect_refused("lookup is 3", [](Settings &s) { s.options.lookup = beyond<smx_lookup>(); });
    const Settings s(8, 0.5, 4, 4);
    smx_image image = nullptr;
    EXPECT_SMX_FAILS(
        SMX_INVALID_ARGUMENT, "brdf is null",
        smx_render_geometric(test::context(), nullptr, &s.scene, &s.options, &s.geometric, &image, nullptr));
}
