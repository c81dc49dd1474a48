// slopemix effects and render --effects: verdicts, reasons and costs, and what is wrong usage.
#include <gtest/gtest.h>

#include "cli.h"
#include "close.h"
#include "files.h"
#include "results.h"
#include "support.h"

using nlohmann::json;
using Arguments = std::vector<std::string>;

namespace {

Arguments render(const std::string &integrator, const std::string &out, const Arguments &more = {}) {
    return test::with({"render", "builtin:conductor", "--integrator", integrator, "--alpha", "0.3,0.3", "--light",
                       "-20", "--res", "48", "--out", out, "--lobes", "2"},
                      more);
}

const Arguments effects = {"effects", "builtin:conductor", "--alpha", "0.3,0.1", "--light", "-20", "--lobes", "2"};

test::Image read(const std::string &path) {
    test::Image image;
    EXPECT_SMX_OK(smx_image_read_exr(path.c_str(), image.out()));
    return image;
}

} // namespace

TEST(CliEffects, TableHasAVerdictAReasonAndACost) {
    const test::CliResult run = test::cli(test::with(effects, {"--json"}));
    ASSERT_CLI_OK(run);
    const json report = run.json();
    ASSERT_EQ(report.at("effects").size(), 8u);
    for (const json &effect : report.at("effects")) {
        EXPECT_FALSE(effect.at("reason").get<std::string>().empty()) << effect;
        const bool supported = effect.at("supported");
        EXPECT_EQ(supported, effect.at("effect") != "interreflection");
        for (const char *number : {"contribution", "ns_with", "ns_without"})
            EXPECT_EQ(effect.at(number).is_number(), supported) << number << " of " << effect;
        EXPECT_TRUE(!supported || effect.at("ns_without").get<double>() > 0.0) << effect;
    }
    EXPECT_GT(report.at("ns_all").get<double>(), 0.0);
    EXPECT_GT(report.at("ns_chosen").get<double>(), 0.0);
    EXPECT_TRUE(report.at("effects")[5].at("on")) << "two alphas";

    const test::CliResult text = test::cli(effects);
    ASSERT_CLI_OK(text);
    for (const char *said : {"height-correlation", "alphas are 0.3 and 0.1", " lobes dropped", "without it"})
        EXPECT_NE(text.out.find(said), std::string::npos) << said << " is not in " << text.out;
}

TEST(CliEffects, RenderSaysWhatItLeavesOutAndWhy) {
    const test::TempDir dir;
    const test::CliResult run = test::cli(render("filtered", dir / "auto.exr", {"--json"}));
    ASSERT_CLI_OK(run);
    const json report = run.json();
    EXPECT_EQ(report.at("effects_asked"), "auto");
    EXPECT_EQ(report.at("effect_tolerance"), 1e-3);
    EXPECT_EQ(report.at("verdicts").size(), 8u);
    EXPECT_LE(report.at("left_out").get<double>(), 1e-3);
    for (const json &on : report.at("effects")) EXPECT_TRUE(on != "anisotropy" && on != "mean-slope") << on;

    const test::CliResult text = test::cli(render("filtered", dir / "text.exr"));
    EXPECT_NE(text.out.find("anisotropy: alpha is 0.3 along both axes"), std::string::npos) << text.out;

    ASSERT_CLI_OK(test::cli(render("filtered", dir / "all.exr", {"--effects", "all"})));
    EXPECT_LE(test::relrmse(read(dir / "auto.exr"), read(dir / "all.exr")), 1e-3);
    ASSERT_CLI_OK(test::cli(render("filtered", dir / "none.exr", {"--effects", "none"})));
    EXPECT_GT(test::relrmse(read(dir / "none.exr"), read(dir / "all.exr")), 1e-3);
}

TEST(CliEffects, SeparableMaskingHasTwoSpellings) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(render("filtered", dir / "g.exr", {"--g", "separable", "--effects", "all"})));
    ASSERT_CLI_OK(test::cli(render("filtered", dir / "list.exr",
                                   {"--effects", "masking,shadowing,fresnel,lobe-color,anisotropy,mean-slope"})));
    EXPECT_EQ(test::relrmse(read(dir / "g.exr"), read(dir / "list.exr")), 0.0);
    const std::string out = dir / "x.exr";
    EXPECT_CLI_FAILS(2, "contradicts",
                     render("filtered", out, {"--g", "separable", "--effects", "masking,height-correlation"}));
    EXPECT_CLI_FAILS(2, "contradicts", render("filtered", out, {"--g", "correlated", "--effects", "masking"}));
}

TEST(CliEffects, WrongNamesAndUnsupportedOnesAreRefused) {
    const test::TempDir dir;
    const std::string out = dir / "x.exr";
    for (const char *wrong : {"frensel", "", "masking,", "auto,masking"})
        EXPECT_CLI_FAILS(2, "masking, shadowing, height-correlation, fresnel, lobe-color",
                         render("filtered", out, {"--effects", wrong}));
    EXPECT_CLI_FAILS(1, "interreflection", render("filtered", out, {"--effects", "masking,interreflection"}));
    EXPECT_CLI_FAILS(1, "fresnel", render("reference", out, {"--effects", "fresnel", "--spp", "64"}));
    EXPECT_CLI_FAILS(1, "bounces", render("geometric", out, {"--effects", "interreflection", "--spp", "64"}));
    EXPECT_CLI_FAILS(2, "--effect-tolerance", render("filtered", out, {"--effect-tolerance", "2"}));
    EXPECT_FALSE(test::exists(out));
}
