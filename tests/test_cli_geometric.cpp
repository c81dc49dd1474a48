// slopemix render --integrator geometric: its flags, its report, and a tile that does not fit.
#include <gtest/gtest.h>

#include "cli.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments geometric(const std::string &out) {
    return {"render",       "builtin:conductor",
            "--integrator", "geometric",
            "--alpha",      "0.25,0.1",
            "--light",      "30",
            "--res",        "16x12",
            "--spp",        "64",
            "--out",        out};
}

} // namespace

TEST(CliGeometric, WritesAnImageAndSaysHow) {
    const test::TempDir dir;
    const std::string out = dir / "a.exr";
    const test::CliResult run =
        test::cli(test::with(geometric(out), {"--tile", "128", "--realisations", "4", "--bounces", "2", "--effects",
                                              "all", "--errors", "--json"}));
    ASSERT_CLI_OK(run);
    const json report = run.json();
    EXPECT_EQ(report.at("integrator"), "geometric");
    EXPECT_EQ(report.at("tile"), 128);
    EXPECT_EQ(report.at("realisations"), 4);
    EXPECT_EQ(report.at("bounces"), 2);
    EXPECT_EQ(report.at("spp"), 64);
    EXPECT_EQ(report.at("light_phi_deg"), 30.0);
    EXPECT_GT(report.at("standard_error").get<double>(), 0.0);
    for (const char *other : {"model", "lobes", "widening_order", "sampler", "g", "grade", "unsettled"})
        EXPECT_TRUE(report.at(other).is_null()) << other;

    test::Image image;
    ASSERT_SMX_OK(smx_image_read_exr(out.c_str(), image.out()));
    EXPECT_NE(smx_image_errors(image), nullptr);
    EXPECT_GT(test::pixels(image).at(10, 6)[0], 0.0f);
    for (const auto &[key, value] : {std::pair{"slopemix.integrator", "geometric"},
                                     {"slopemix.tile", "128"},
                                     {"slopemix.realisations", "4"},
                                     {"slopemix.bounces", "2"},
                                     {"slopemix.effects", "masking,shadowing,anisotropy,mean-slope,interreflection"}})
        EXPECT_STREQ(smx_image_get_attribute(image, key), value) << key;
}

TEST(CliGeometric, UniformLight) {
    const test::TempDir dir;
    const Arguments furnace = test::replaced(geometric(dir / "a.exr"), "--light", "uniform");
    const test::CliResult run = test::cli(test::with(furnace, {"--json"}));
    ASSERT_CLI_OK(run);
    EXPECT_EQ(run.json().at("light"), "uniform");
    EXPECT_TRUE(run.json().at("light_phi_deg").is_null());
    test::Image image;
    ASSERT_SMX_OK(smx_image_read_exr((dir / "a.exr").c_str(), image.out()));
    EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.light"), "uniform");
    EXPECT_EQ(smx_image_get_attribute(image, "slopemix.light_phi"), nullptr);
}

TEST(CliGeometric, BadFlagsAreRefusedByName) {
    const test::TempDir dir;
    const Arguments good = geometric(dir / "a.exr");
    const std::vector<std::pair<std::string, Arguments>> bad = {{"--tile", {"0", "32", "100", "16384", "x"}},
                                                                {"--realisations", {"0", "65537", "3"}},
                                                                {"--bounces", {"-1", "1025"}}};
    for (const auto &[flag, values] : bad)
        for (const std::string &value : values) EXPECT_CLI_FAILS(2, flag, test::with(good, {flag, value}));
    EXPECT_CLI_FAILS(2, "--errors", test::with(good, {"--realisations", "1", "--errors"}));
    EXPECT_TRUE(dir.names().empty());

    const test::CliResult noted = test::cli(test::with(good, {"--sampler", "grid", "--g", "separable"}));
    ASSERT_CLI_OK(noted);
    for (const char *flag : {"--sampler", "--g"})
        EXPECT_NE(noted.err.find(std::string(flag) + " has no effect"), std::string::npos) << noted.err;
}

// PoCL's device has as many GiB as the variable says, and a buffer may have a quarter of them.
TEST(CliGeometric, TooLargeATileIsToldHowLargeItMayBe) {
    const test::TempDir dir;
    const test::CliSetting small{{{"POCL_MEMORY_LIMIT", "1"}}, 0};
    EXPECT_CLI_FAILS(1, "tile is 8192; it must be at most 4096",
                     test::with(geometric(dir / "a.exr"), {"--tile", "8192"}), small);
    EXPECT_TRUE(dir.names().empty());
}
