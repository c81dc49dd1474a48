// Images under a uniform light: the filter and the statistical reference against integrals over all light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "files.h"
#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "support.h"

using oracle::Masking;
using oracle::Rgb;
using oracle::Vec;

namespace {

constexpr int side = 12; // of an image

smx_scene furnace(const smx_displacement &x, smx_masking g = SMX_G2_CORRELATED, uint32_t size = side) {
    smx_scene scene = test::make_scene(size, size, 0.0, x, g);
    scene.light = SMX_LIGHT_UNIFORM;
    return scene;
}

smx_render_options samples(uint32_t spp, uint64_t seed = 0) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.spp = spp;
    options.seed = seed;
    options.errors = 1;
    return options;
}

struct Rendered {
    test::Image image;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    const float *pixels() const { return smx_image_pixels(image); }
    const float *errors() const { return smx_image_errors(image); }
};

Rendered filtered(smx_material material, const smx_scene &scene, const smx_render_options &options,
                  smx_context where = nullptr) {
    Rendered r;
    EXPECT_SMX_OK(
        smx_render_filtered(where ? where : test::context(), material, &scene, &options, r.image.out(), &r.report));
    return r;
}

Rendered reference(smx_brdf brdf, const smx_scene &scene, const smx_render_options &options,
                   smx_context where = nullptr) {
    Rendered r;
    EXPECT_SMX_OK(
        smx_render_reference(where ? where : test::context(), brdf, &scene, &options, r.image.out(), &r.report));
    return r;
}

test::Brdf open(const char *name) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_brdf_open(name, brdf.out()));
    return brdf;
}

// Pixels in the middle, half way out, near the silhouette and near a pole.
constexpr std::pair<int, int> places[] = {{6, 6}, {9, 4}, {0, 5}, {7, 11}, {2, 2}};

Vec viewer(int column, int row) {
    const oracle::Pixel p = oracle::sphere_pixel(side, side, column, row, 0.0);
    EXPECT_TRUE(p.on_sphere);
    return p.wo;
}

// Values are means of eight scrambles, whose t has 7 degrees of freedom: one in 2000 is beyond.
constexpr double t_limit = 6.0;
// Nodes of the oracle's integrals, and the table's and the numbers' roundings.
constexpr double oracle_tolerance = 3e-4;

// Of red, green and blue.
void expect_pixel(const Rendered &r, int column, int row, const Rgb &wanted) {
    const std::size_t at = 4 * static_cast<std::size_t>(row * side + column);
    for (std::size_t c = 0; c < 3; ++c) {
        const double got = r.pixels()[at + c], error = r.errors()[at + c];
        EXPECT_TRUE(error > 0.0 || wanted[c] == 0.0);
        EXPECT_LE(std::abs(got - wanted[c]), t_limit * error + oracle_tolerance * wanted[c])
            << "pixel " << column << " " << row << ", channel " << c << ": got " << got << " +- " << error
            << ", wanted " << wanted[c];
    }
}

// Integral over the directions above, by midpoints in polar angle and azimuth.
Rgb over_light(int polar, const std::function<Rgb(const Vec &wi)> &value) {
    Rgb sum{};
    const double step = oracle::pi / 2.0 / polar;
    for (int j = 0; j < polar; ++j)
        for (int k = 0; k < 4 * polar; ++k) {
            const double theta = (j + 0.5) * step;
            const Rgb at = value(oracle::spherical(theta, (k + 0.5) * step));
            for (std::size_t c = 0; c < 3; ++c) sum[c] += at[c] * std::sin(theta) * step * step;
        }
    return sum;
}

// Mean over X's slopes, which are uncorrelated, by midpoints: `value` of slopes.
double over_slopes(const smx_displacement &x, int nodes, const std::function<double(double, double)> &value) {
    constexpr double reach = 4.2; // in alphas: 3e-9 lies beyond
    const double step = 2.0 * reach / nodes;
    double sum = 0.0;
    for (int j = 0; j < nodes; ++j)
        for (int k = 0; k < nodes; ++k) {
            const double a = -reach + (j + 0.5) * step, b = -reach + (k + 0.5) * step;
            sum += std::exp(-a * a - b * b) / oracle::pi * step * step *
                   value(x.mean_slope_x + a * x.alpha_x, x.mean_slope_y + b * x.alpha_y);
        }
    return sum;
}

Vec normal_of(double slope_x, double slope_y) { return oracle::normalised({-slope_x, -slope_y, 1.0}); }

double mean(const Rendered &r, const smx_scene &scene) {
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < std::size_t{scene.width} * scene.height; ++k)
        if (r.pixels()[4 * k + 3] > 0.0f) sum += r.pixels()[4 * k], ++count;
    return sum / count;
}

// Two lobes with curves of their own, of three knots.
const std::vector<oracle::Lobe> lobes = {{0.3, 0.2}, {0.7, 0.5}};
constexpr std::size_t knots = 3;
const std::vector<double> curves = {0.9, 0.5, 1.0, 0.2, 0.6, 0.8, 0.4, 0.4, 0.4,  // lobe 0: r, g, b
                                    0.3, 0.3, 0.5, 0.7, 0.2, 0.1, 0.0, 0.1, 0.9}; // lobe 1

double curve(std::size_t set, std::size_t channel, double theta_d) {
    const double at = theta_d / (oracle::pi / 2.0) * (knots - 1);
    const auto below = std::min(static_cast<std::size_t>(at), knots - 2);
    const double *f = curves.data() + (3 * set + channel) * knots + below;
    return f[0] + (f[1] - f[0]) * (at - static_cast<double>(below));
}

Rgb two_lobes(const smx_scene &scene, const Vec &wi, const Vec &wo) {
    const double theta_d = std::acos(std::min(1.0, oracle::dot(wi, oracle::normalised(wi + wo))));
    Rgb sum{};
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        const oracle::Mixture m{{{1.0, lobes[k].alpha}}, test::gaussian(scene.displacement)};
        const double fcos = oracle::fcos(m, test::masking(scene.masking), wi, wo);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += curve(k, c, theta_d) * fcos;
    }
    return sum;
}

const smx_displacement surfaces[] = {
    {0.0, 0.0, 0.0, 0.0, 0.0}, {0.5, 0.5, 0.0, 0.0, 0.0}, {0.5, 0.0, 0.0, 0.0, 0.0}, {0.3, 0.2, 0.7, 0.3, -0.2}};

} // namespace

TEST(Uniform, FilteredIsTheIntegralOverAllLight) {
    const test::Material material = test::make_material(SMX_MODEL_PER_LOBE, lobes, curves, knots);
    for (const smx_displacement &x : surfaces)
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
            const smx_scene scene = furnace(x, g);
            const Rendered r = filtered(material, scene, samples(4096));
            EXPECT_LT(r.report.standard_error, 0.004);
            for (const auto &[column, row] : places) {
                const Vec wo = viewer(column, row);
                SCOPED_TRACE(::testing::Message() << "X " << x.alpha_x << " " << x.alpha_y << ", g " << g);
                expect_pixel(r, column, row, over_light(64, [&](const Vec &wi) { return two_lobes(scene, wi, wo); }));
            }
        }
}

// The shared model, and a lobe far narrower than its neighbour.
TEST(Uniform, FilteredTakesNarrowLobes) {
    const test::Material material = test::make_material({{0.5, 1e-3}, {0.5, 0.6}}, test::channel_fresnel);
    const smx_scene scene = furnace(surfaces[0]);
    const oracle::Mixture m{{{0.5, 1e-3}, {0.5, 0.6}}, {}};
    const Rendered r = filtered(material, scene, samples(16384));
    for (const auto &[column, row] : places) {
        const Vec wo = viewer(column, row);
        // The narrow lobe's half of the density is seen in the mirrored direction alone.
        const Vec mirrored{-wo.x, -wo.y, wo.z};
        const double mirror = 0.5 * oracle::g2(Masking::correlated, m, mirrored, wo);
        double wide = over_light(128, [&](const Vec &wi) {
            const oracle::Mixture alone{{{1.0, 0.6}}, {}};
            const double ndf = oracle::ndf(alone, oracle::normalised(wi + wo));
            const double value = 0.5 * ndf * oracle::g2(Masking::correlated, m, wi, wo) / (4.0 * wo.z);
            return Rgb{value, value, value};
        })[0];
        expect_pixel(r, column, row, {mirror + wide, 0.5 * (mirror + wide), 0.25 * (mirror + wide)});
    }
}

// What quadrature converges to is the reference; the closed form is not.
TEST(Uniform, WideningConvergesToTheReference) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.3}}, Masking::correlated));
    const test::Material material = test::make_material({{1.0, 0.3}}, test::channel_fresnel);
    for (const smx_displacement &x : {smx_displacement{0.5, 0.5, 0.0, 0.0, 0.0}, {0.0, 0.5, 0.0, 0.0, 0.0}}) {
        const smx_scene scene = furnace(x);
        const Rendered wanted = reference(brdf, scene, samples(65536));
        smx_render_options options = samples(4096);
        const Rendered closed = filtered(material, scene, options);
        options.widening_order = 5;
        const Rendered widened = filtered(material, scene, options);
        const double error = std::hypot(wanted.report.standard_error, widened.report.standard_error);
        EXPECT_LT(test::relrmse(widened.image, wanted.image), 1.5 * error);
        EXPECT_GT(test::relrmse(closed.image, wanted.image), 3.0 * error);
        EXPECT_LT(widened.report.unsettled, 0.05);
        EXPECT_EQ(widened.report.widening_orders[0], 5);
    }
}

// Nothing hides a facet: of the light above the surface, a facet's share is (1 + wm.z) / 2, and the viewer's mean over
// facets is by their projected areas.
TEST(Uniform, WhiteDiffuseReferenceWithoutEffects) {
    const test::Brdf brdf = open("analytic:lambert,albedo=1");
    for (const smx_displacement &x : {surfaces[1], smx_displacement{0.8, 0.2, 0.0, 0.0, 0.0}}) {
        const smx_scene scene = furnace(x);
        smx_render_options options = samples(16384);
        options.effects = SMX_EFFECT_ANISOTROPY;
        const Rendered r = reference(brdf, scene, options);
        EXPECT_EQ(r.report.effects, uint32_t{SMX_EFFECT_ANISOTROPY});
        for (const auto &[column, row] : places) {
            const Vec wo = viewer(column, row);
            const double wanted = over_slopes(x, 400, [&](double slope_x, double slope_y) {
                const Vec wm = normal_of(slope_x, slope_y);
                return std::max(oracle::dot(wo, wm), 0.0) / wm.z / wo.z * (1.0 + wm.z) / 2.0;
            });
            expect_pixel(r, column, row, {wanted, wanted, wanted});
        }
    }
}

// And with Smith's masking, which loses light at every facet that another hides.
TEST(Uniform, WhiteDiffuseReference) {
    const test::Brdf brdf = open("analytic:lambert,albedo=1");
    const std::pair<smx_displacement, smx_masking> cases[] = {{surfaces[1], SMX_G2_CORRELATED},
                                                              {surfaces[1], SMX_G2_SEPARABLE},
                                                              {{0.3, 0.2, 0.0, 0.5, -0.2}, SMX_G2_CORRELATED}};
    for (const auto &[x, g] : cases) {
        const smx_scene scene = furnace(x, g);
        const oracle::Gaussian surface = test::gaussian(x);
        const Rendered r = reference(brdf, scene, samples(16384));
        for (const auto &[column, row] : places) {
            const Vec wo = viewer(column, row);
            const double wanted = over_light(32, [&, &x = x, &g = g](const Vec &wi) {
                if (oracle::plane(surface, wi) <= 0.0 || oracle::plane(surface, wo) <= 0.0) return Rgb{};
                const double g2 = oracle::g2(test::masking(g), surface, wi, wo);
                const double hidden = g2 / oracle::pi / oracle::plane(surface, wo);
                const double value =
                    hidden * over_slopes(x, 64, [&](double slope_x, double slope_y) {
                        const Vec wm = normal_of(slope_x, slope_y);
                        return std::max(oracle::dot(wo, wm), 0.0) * std::max(oracle::dot(wi, wm), 0.0) / wm.z;
                    });
                return Rgb{value, value, value};
            })[0];
            EXPECT_LT(wanted, 0.99);
            SCOPED_TRACE(::testing::Message() << "X " << x.alpha_x << " " << x.alpha_y << ", g " << g);
            expect_pixel(r, column, row, {wanted, wanted, wanted});
        }
    }
}

TEST(Uniform, WhiteSmoothSurfacesReflectAllLight) {
    for (const char *name : {"analytic:lambert,albedo=1", "builtin:mirror"}) {
        const smx_scene scene = furnace(surfaces[0]);
        const Rendered r = reference(open(name), scene, samples(4096));
        EXPECT_NEAR(mean(r, scene), 1.0, 0.004) << name; // of the mirror's table between its nodes
    }
}

// Nearly smooth, Smith's masking and what rays meet are the same.
TEST(Uniform, ReferenceIsTheGeometricOneOnAnAlmostSmoothSurface) {
    const test::Brdf brdf = open("analytic:lambert,albedo=1");
    const smx_scene scene = furnace({0.1, 0.1, 0.0, 0.0, 0.0}, SMX_G2_CORRELATED, 24);
    const Rendered r = reference(brdf, scene, samples(16384));
    Rendered geometric;
    const smx_render_options options = samples(16 * 1024);
    ASSERT_SMX_OK(smx_render_geometric(test::context(), brdf, &scene, &options, nullptr, geometric.image.out(),
                                       &geometric.report));
    double beyond = 0.0, count = 0.0;
    for (std::size_t k = 0; k < std::size_t{4} * 24 * 24; k += 4) {
        if (r.pixels()[k + 3] == 0.0f) continue;
        const double error = std::hypot(r.errors()[k], geometric.errors()[k]);
        beyond += std::abs(r.pixels()[k] - geometric.pixels()[k]) > 4.0 * error;
        ++count;
    }
    EXPECT_GT(count, 400.0);
    EXPECT_LT(beyond / count, 0.01);
    EXPECT_NEAR(mean(r, scene), mean(geometric, scene), 0.001);
}

namespace {

// Share of the pixels whose true value is beyond the 5 % limit of Student's t of 7 degrees of freedom, and the ratio of
// the image's error to the one that is told.
void expect_honest(const Rendered &r, const Rendered &truth, const smx_scene &scene, const char *what) {
    double beyond = 0.0, count = 0.0;
    for (std::size_t k = 0; k < std::size_t{4} * scene.width * scene.height; k += 4) {
        if (truth.pixels()[k + 3] == 0.0f) continue;
        beyond += std::abs(r.pixels()[k] - truth.pixels()[k]) > 2.3646 * r.errors()[k];
        ++count;
    }
    // 1600 pixels with numbers of their own: 5 % +- 0.6 %; means are a little skewed.
    EXPECT_NEAR(beyond / count, 0.05, 0.025) << what;
    EXPECT_NEAR(test::relrmse(r.image, truth.image) / r.report.standard_error, 1.0, 0.2) << what;
}

} // namespace

TEST(Uniform, StandardErrorIsTheError) {
    const smx_scene scene = furnace({0.4, 0.2, 0.0, 0.0, 0.0}, SMX_G2_CORRELATED, 46);
    const test::Material material = test::make_material({{0.3, 0.05}, {0.7, 0.4}});
    expect_honest(filtered(material, scene, samples(256, 1)), filtered(material, scene, samples(16384, 2)), scene,
                  "filtered");
    // Sobol does not know of a narrow lobe, and what it seldom meets makes its means lean.
    const std::vector<oracle::Lobe> wide = {{1.0, 0.4}}, narrow = {{0.3, 0.05}, {0.7, 0.4}};
    for (const smx_sampler sampler : {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) {
        const bool is_mis = sampler == SMX_SAMPLER_MIS;
        const test::Brdf brdf = test::make_brdf(test::beckmann_table(is_mis ? narrow : wide, Masking::correlated));
        smx_render_options options = samples(1024, 1);
        options.sampler = sampler;
        expect_honest(reference(brdf, scene, options), reference(brdf, scene, samples(16384, 2)), scene,
                      is_mis ? "mis" : "sobol");
    }
}

TEST(Uniform, TargetErrorIsReached) {
    const smx_scene scene = furnace(surfaces[1]);
    smx_render_options options = samples(16);
    options.target_error = 0.005;
    const Rendered a = filtered(test::make_material({{1.0, 0.2}}), scene, options);
    EXPECT_LE(a.report.standard_error, 0.005);
    const Rendered b = reference(open("builtin:conductor"), scene, options);
    EXPECT_LE(b.report.standard_error, 0.005);
    EXPECT_GT(b.report.spp, 64u);
    options.target_error = 0.0;
    options.errors = 0;
    options.spp = 18; // in one scramble
    EXPECT_LT(filtered(test::make_material({{1.0, 0.2}}), scene, options).report.standard_error, 0.0);
}

// A furnace does not depend on the grade, but for its arithmetic.
TEST(Uniform, GradesAgree) {
    const smx_scene scene = furnace(surfaces[3]);
    const test::Material material = test::make_material({{0.3, 0.05}, {0.7, 0.4}});
    const test::Brdf brdf = open("builtin:conductor");
    smx_render_options options = samples(256);
    const Rendered f = filtered(material, scene, options), r = reference(brdf, scene, options);
    for (const smx_grade grade : {SMX_GRADE_FAST, SMX_GRADE_DOUBLE}) {
        if (grade == SMX_GRADE_DOUBLE && !test::has_double()) continue;
        options.grade = grade;
        EXPECT_LT(test::relrmse(filtered(material, scene, options).image, f.image), 1e-3) << grade;
        EXPECT_LT(test::relrmse(reference(brdf, scene, options).image, r.image), 2e-3) << grade;
    }
}

namespace {

bool same_bits(const Rendered &a, const Rendered &b, const smx_scene &scene) {
    const std::size_t values = std::size_t{4} * scene.width * scene.height;
    return std::equal(a.pixels(), a.pixels() + values, b.pixels()) &&
           std::equal(a.errors(), a.errors() + values, b.errors());
}

} // namespace

TEST(Uniform, SameBitsOnAnyNumberOfDevices) {
    smx_scene scene = furnace(surfaces[1], SMX_G2_CORRELATED, 93);
    scene.height = 71;
    smx_context_options halves = SMX_CONTEXT_OPTIONS_INIT;
    halves.sub_devices = 2;
    test::Context two;
    ASSERT_SMX_OK(smx_context_create(&halves, two.out()));
    const test::Material material = test::make_material({{1.0, 0.2}});
    const test::Brdf brdf = open("builtin:two-layer");
    const smx_render_options options = samples(48), other = samples(48, 1);
    const Rendered f = filtered(material, scene, options), r = reference(brdf, scene, options);
    EXPECT_TRUE(same_bits(f, filtered(material, scene, options, two), scene));
    EXPECT_TRUE(same_bits(r, reference(brdf, scene, options, two), scene));
    EXPECT_FALSE(same_bits(f, filtered(material, scene, other), scene));
    EXPECT_FALSE(same_bits(r, reference(brdf, scene, other), scene));
}

TEST(Uniform, FilesHoldTheSameImageAndSayHow) {
    const test::TempDir dir;
    const std::string path = dir / "a.exr";
    const smx_scene scene = furnace(surfaces[1]);
    smx_render_options options = samples(64);
    const test::Material material = test::make_material({{1.0, 0.2}});
    const Rendered wanted = filtered(material, scene, options);
    options.exr_path = path.c_str();
    ASSERT_SMX_OK(smx_render_filtered(test::context(), material, &scene, &options, nullptr, nullptr));
    Rendered read;
    ASSERT_SMX_OK(smx_image_read_exr(path.c_str(), read.image.out()));
    EXPECT_TRUE(same_bits(read, wanted, scene));
    EXPECT_STREQ(smx_image_get_attribute(read.image, "slopemix.light"), "uniform");
    EXPECT_STREQ(smx_image_get_attribute(read.image, "slopemix.spp"), "64");
    EXPECT_EQ(smx_image_get_attribute(read.image, "slopemix.light_phi"), nullptr);
}

TEST(Uniform, StopsWhereItIsToldTo) {
    const smx_scene scene = furnace(surfaces[1]);
    smx_render_options options = samples(4096);
    int calls = 0;
    options.progress_user = &calls;
    options.progress = [](void *user, double) { return ++*static_cast<int *>(user) >= 2 ? 1 : 0; };
    smx_image image = nullptr;
    EXPECT_SMX_FAILS(
        SMX_CANCELLED, "cancelled",
        smx_render_filtered(test::context(), test::make_material({{1.0, 0.2}}), &scene, &options, &image, nullptr));
    EXPECT_SMX_FAILS(
        SMX_CANCELLED, "cancelled",
        smx_render_reference(test::context(), open("builtin:conductor"), &scene, &options, &image, nullptr));
    EXPECT_EQ(image, nullptr);
}

// Auto leaves out nothing, for nothing is judged.
TEST(Uniform, AutoEffectsAreAll) {
    const smx_scene scene = furnace({0.01, 0.01, 0.0, 0.0, 0.0});
    smx_render_options options = samples(64);
    const test::Material material = test::make_material({{1.0, 0.2}});
    const Rendered by_itself = filtered(material, scene, options);
    options.effects = SMX_EFFECTS_ALL;
    const Rendered all = filtered(material, scene, options);
    EXPECT_TRUE(same_bits(by_itself, all, scene));
    EXPECT_EQ(by_itself.report.effects, all.report.effects);
}

TEST(Uniform, WhatTakesOneDirectionRefuses) {
    const smx_scene scene = furnace(surfaces[1]);
    const test::Material material = test::make_material({{1.0, 0.2}});
    const test::Brdf brdf = open("builtin:conductor");
    smx_image image = nullptr;
    smx_render_options options = samples(64);
    options.widening_order = SMX_WIDENING_AUTO;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "widening_order is -1 (auto); under a uniform light",
                     smx_render_filtered(test::context(), material, &scene, &options, &image, nullptr));
    options = samples(64);
    options.errors = 0;
    options.sampler = SMX_SAMPLER_GRID;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "sampler is 0 (grid); under a uniform light",
                     smx_render_reference(test::context(), brdf, &scene, &options, &image, nullptr));
    options = samples(24);
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "spp is 24; errors need a multiple of 16",
                     smx_render_filtered(test::context(), material, &scene, &options, &image, nullptr));
    EXPECT_EQ(image, nullptr);
    smx_effect_report effects = SMX_EFFECT_REPORT_INIT;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "light is 1 (uniform)",
                     smx_material_effects(material, &scene, nullptr, &effects));
    smx_choose_options request = SMX_CHOOSE_OPTIONS_INIT;
    request.max_error = 0.1;
    smx_choice choice = SMX_CHOICE_INIT;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "light is 1 (uniform)",
                     smx_choose(test::context(), brdf, nullptr, 0, &scene, nullptr, &request, &choice));
}
