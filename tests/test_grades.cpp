// Grades of arithmetic: precise images are the double ones as far as float directions allow, fast ones to about 1e-3,
// and each grade is one of its own.
#include <gtest/gtest.h>

#include <cstring>

#include "support.h"

using oracle::Lobe;

namespace {

// What is promised of precise: float roundings of directions and slopes, which sharp lobes amplify.
double precise_bound(double least_alpha) { return least_alpha >= 0.01 ? 1e-5 : 1e-7 / least_alpha; }
// Errors of elementary functions of 1e-4, a few of them in a row.
constexpr double fast_bound = 1e-3;

test::Image filtered(smx_material material, const smx_scene &scene, smx_grade grade) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.grade = grade;
    test::Image image;
    EXPECT_SMX_OK(smx_render_filtered(test::context(), material, &scene, &options, image.out(), nullptr));
    return image;
}

test::Image reference(smx_brdf brdf, const smx_scene &scene, smx_sampler sampler, smx_grade grade) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.sampler = sampler;
    options.spp = 256;
    options.grade = grade;
    test::Image image;
    EXPECT_SMX_OK(smx_render_reference(test::context(), brdf, &scene, &options, image.out(), nullptr));
    return image;
}

struct Base {
    test::Material material;
    double least_alpha;
};

std::vector<Base> bases() {
    const std::vector<Lobe> soft{{0.5, 0.02}, {0.3, 0.2}, {0.2, 0.7}}, sharp{{0.5, 0.001}, {0.5, 0.3}};
    const std::vector<test::Colour> colours{{0.9, 0.6, 0.3}, {0.1, 0.2, 0.3}, {0.0, 0.1, 0.2}};
    std::vector<Base> list;
    list.push_back({test::make_material(soft, test::channel_fresnel), 0.02});
    list.push_back({test::make_per_lobe_material(soft, colours), 0.02});
    list.push_back({test::make_material({{1.0, 0.01}}), 0.01});
    list.push_back({test::make_material(sharp), 0.001});
    return list;
}

const smx_displacement displacements[] = {
    {0.0, 0.0, 0.0, 0.0, 0.0}, {0.25, 0.25, 0.0, 0.0, 0.0}, {0.5, 0.0, 0.0, 0.0, 0.0}, {0.3, 0.2, 0.7, 0.1, -0.2}};

double widened(double alpha, const smx_displacement &x) {
    // The least alpha of X along any axis is at most the lesser one, times sqrt(1 - rho^2) at least.
    return std::hypot(alpha, std::min(x.alpha_x, x.alpha_y) * std::sqrt(1.0 - x.rho * x.rho));
}

bool same_bits(smx_image a, smx_image b) {
    const test::Pixels x = test::pixels(a), y = test::pixels(b);
    return std::memcmp(x.rgba, y.rgba, std::size_t{16} * x.width * x.height) == 0;
}

} // namespace

TEST(Grades, FilteredImagesAgree) {
    if (!test::has_double()) GTEST_SKIP() << "the device has no doubles";
    for (const Base &base : bases())
        for (const smx_displacement &x : displacements)
            for (const double light : {90.0, 0.0, -25.0})
                for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
                    const smx_scene scene = test::make_scene(128, 128, test::radians(light), x, g);
                    const test::Image exact = filtered(base.material, scene, SMX_GRADE_DOUBLE);
                    const double precise = test::relrmse(filtered(base.material, scene, SMX_GRADE_PRECISE), exact);
                    const double fast = test::relrmse(filtered(base.material, scene, SMX_GRADE_FAST), exact);
                    const double bound = precise_bound(widened(base.least_alpha, x));
                    EXPECT_LT(precise, bound) << "alpha " << base.least_alpha << ", X " << x.alpha_x << " " << x.alpha_y
                                              << ", light " << light << ", masking " << g;
                    EXPECT_LT(fast, fast_bound) << "alpha " << base.least_alpha << ", light " << light;
                    EXPECT_GT(fast, 2.0 * precise) << "fast is no less exact than precise";
                }
}

TEST(Grades, ReferencesAgree) {
    if (!test::has_double()) GTEST_SKIP() << "the device has no doubles";
    const test::Brdf brdf =
        test::make_brdf(test::beckmann_table({{0.6, 0.1}, {0.4, 0.5}}, oracle::Masking::correlated));
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS})
        for (const double light : {90.0, 0.0, -25.0}) {
            const smx_scene scene = test::make_scene(64, 64, test::radians(light), displacements[1]);
            const test::Image exact = reference(brdf, scene, sampler, SMX_GRADE_DOUBLE);
            const double precise = test::relrmse(reference(brdf, scene, sampler, SMX_GRADE_PRECISE), exact);
            const double fast = test::relrmse(reference(brdf, scene, sampler, SMX_GRADE_FAST), exact);
            EXPECT_LT(precise, precise_bound(0.1)) << "sampler " << sampler << ", light " << light;
            EXPECT_LT(fast, fast_bound) << "sampler " << sampler << ", light " << light;
            EXPECT_GT(fast, 2.0 * precise) << "sampler " << sampler << ", light " << light;
        }
}

TEST(Grades, ImagesSayTheirs) {
    const test::Material material = test::make_material({{1.0, 0.1}});
    const smx_scene scene = test::make_scene(32, 32, 0.0, displacements[1]);
    const test::Image precise = filtered(material, scene, SMX_GRADE_PRECISE);
    const test::Image fast = filtered(material, scene, SMX_GRADE_FAST);
    EXPECT_STREQ(smx_image_get_attribute(precise, "slopemix.grade"), "precise");
    EXPECT_STREQ(smx_image_get_attribute(fast, "slopemix.grade"), "fast");
    EXPECT_FALSE(same_bits(precise, fast));
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.3}}, oracle::Masking::correlated));
    EXPECT_STREQ(smx_image_get_attribute(reference(brdf, scene, SMX_SAMPLER_SOBOL, SMX_GRADE_FAST), "slopemix.grade"),
                 "fast");
}

TEST(Grades, OthersAreRefused) {
    const test::Material material = test::make_material({{1.0, 0.1}});
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.3}}, oracle::Masking::correlated));
    const smx_scene scene = test::make_scene(8, 8, 0.0, {});
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    for (const int value : {-1, 3}) {
        options.grade = static_cast<smx_grade>(value);
        test::Image image;
        EXPECT_EQ(smx_render_filtered(test::context(), material, &scene, &options, image.out(), nullptr),
                  SMX_INVALID_ARGUMENT);
        EXPECT_NE(std::strstr(smx_last_error(), "grade is"), nullptr) << smx_last_error();
        EXPECT_EQ(smx_render_reference(test::context(), brdf, &scene, &options, image.out(), nullptr),
                  SMX_INVALID_ARGUMENT);
    }
}
