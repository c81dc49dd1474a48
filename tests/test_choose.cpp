// The choice by error and by time: what is exact, what is dearer, what is refused.
#include <gtest/gtest.h>

#include <vector>

#include "choose_cases.h"

namespace {

const test::ChooseSubject &subject() {
    static const test::ChooseSubject two_layer = test::choose_subject("builtin:two-layer");
    return two_layer;
}

smx_scene scene_of(double alpha_x, double alpha_y, uint32_t size = 48) {
    return test::make_scene(size, size, 0.3, {alpha_x, alpha_y, 0, 0, 0});
}

smx_status choose(const smx_scene &scene, const smx_choose_options &options, smx_choice &choice,
                  smx_brdf brdf = subject().brdf) {
    std::vector<smx_material> materials(subject().materials.begin(), subject().materials.end());
    return smx_choose(test::context(), brdf, materials.data(), materials.size(), &scene, nullptr, &options, &choice);
}

smx_choose_options within_error(double error) {
    smx_choose_options options = SMX_CHOOSE_OPTIONS_INIT;
    options.max_error = error;
    return options;
}

smx_choose_options within_seconds(double seconds) {
    smx_choose_options options = SMX_CHOOSE_OPTIONS_INIT;
    options.max_seconds = seconds;
    return options;
}

// On the device of the library's costs, which do not change from run to run but for a rounding.
constexpr double rounding = 1e-9;
double cost(const smx_choice &choice) { return choice.picked.seconds / choice.device_speed; }

} // namespace

TEST(Choose, SmallerErrorsNeverCostLess) {
    double last = 0.0;
    for (const double error : {0.8, 0.3, 0.1, 0.03, 0.01}) {
        smx_choice choice = SMX_CHOICE_INIT;
        ASSERT_SMX_OK(choose(scene_of(0.3, 0.2), within_error(error), choice));
        EXPECT_LE(choice.picked.error, error);
        EXPECT_GE(cost(choice), (1.0 - rounding) * last) << choice.reason;
        last = cost(choice);
    }
    EXPECT_GT(last, 0.0);
}

// Times so far apart that a busy machine's speed, which is measured anew each time, does not matter.
TEST(Choose, MoreTimeIsMoreAccurate) {
    smx_choice cheapest = SMX_CHOICE_INIT;
    ASSERT_SMX_OK(choose(scene_of(0.3, 0.2), within_error(1.0), cheapest));
    double errors[2] = {};
    for (int k = 0; k < 2; ++k) {
        smx_choice choice = SMX_CHOICE_INIT;
        const double seconds = cheapest.picked.seconds * (k == 0 ? 30.0 : 30000.0);
        ASSERT_SMX_OK(choose(scene_of(0.3, 0.2), within_seconds(seconds), choice));
        EXPECT_LE(choice.picked.seconds, seconds);
        errors[k] = choice.picked.error;
    }
    EXPECT_LT(errors[1], 0.5 * errors[0]);
}

// All lit pixels are in the pilot: its error is the image's, but for what its truth lacks.
TEST(Choose, PredictsTheErrorOfASmallImage) {
    const smx_scene scene = scene_of(0.4, 0.4, 20);
    smx_render_options many = SMX_RENDER_OPTIONS_INIT;
    many.target_error = 0.001;
    many.seed = 5;
    const test::Image truth = test::render_reference(subject().brdf, scene, many);
    for (const double error : {0.2, 0.05, 0.015}) {
        smx_choice choice = SMX_CHOICE_INIT;
        ASSERT_SMX_OK(choose(scene, within_error(error), choice));
        const double real = test::relrmse(test::render_configuration(subject(), scene, choice.picked), truth);
        EXPECT_NEAR(choice.picked.error / real, 1.0, 0.2) << choice.reason;
    }
}

TEST(Choose, SmoothSurfacesNeedOneSample) {
    smx_choice choice = SMX_CHOICE_INIT;
    ASSERT_SMX_OK(choose(scene_of(0.0, 0.0), within_error(1e-5), choice));
    EXPECT_EQ(choice.picked.material, SMX_BY_REFERENCE);
    EXPECT_EQ(choice.picked.spp, 1u);
    EXPECT_EQ(choice.picked.error, 0.0);
}

TEST(Choose, DarkScenesCostNothing) {
    smx_scene dark = scene_of(0.3, 0.3);
    dark.light_phi = -1.5707963267948966;
    smx_choice choice = SMX_CHOICE_INIT;
    ASSERT_SMX_OK(choose(dark, within_error(0.01), choice));
    EXPECT_EQ(choice.pilot_pixels, 0u);
}

TEST(Choose, SaysWhatCostsLessAndWhatIsBetter) {
    smx_choice choice = SMX_CHOICE_INIT;
    ASSERT_SMX_OK(choose(scene_of(0.3, 0.2), within_error(0.05), choice));
    ASSERT_TRUE(choice.has_cheaper && choice.has_better);
    EXPECT_LT(choice.cheaper.seconds, choice.picked.seconds);
    EXPECT_GT(choice.cheaper.error, 0.05);
    EXPECT_GT(choice.better.seconds, choice.picked.seconds);
    EXPECT_LT(choice.better.error, choice.picked.error);
}

TEST(Choose, RefusesWhatNothingReaches) {
    smx_choice choice = SMX_CHOICE_INIT;
    choice.seconds = -7.0;
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "the least that can be reached",
                     choose(scene_of(0.3, 0.2, 8), within_error(1e-7), choice));
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "the least that can be reached",
                     choose(scene_of(0.3, 0.2), within_error(1e-3), choice, nullptr));
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "max_seconds is 1e-09; the cheapest",
                     choose(scene_of(0.3, 0.2), within_seconds(1e-9), choice));
    EXPECT_EQ(choice.seconds, -7.0);
}

TEST(Choose, MaterialsAloneAreFiltered) {
    smx_choice choice = SMX_CHOICE_INIT;
    ASSERT_SMX_OK(choose(scene_of(0.3, 0.2), within_error(0.5), choice, nullptr));
    EXPECT_GE(choice.picked.material, 0);
    EXPECT_LT(choice.pilot_error, 0.0);
}
