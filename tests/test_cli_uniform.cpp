// slopemix render --light uniform by the filter and by the statistical reference: flags, report, what is refused.
#include <gtest/gtest.h>

#include "cli.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments furnace(const std::string &integrator, const std::string &out) {
    return {"render",       "builtin:conductor",
            "--integrator", integrator,
            "--alpha",      "0.5,0.3",
            "--light",      "uniform",
            "--res",        "16x12",
            "--spp",        "64",
            "--lobes",      "1",
            "--out",        out};
}

} // namespace

TEST(CliUniform, WritesImagesAndSaysHow) {
    const test::TempDir dir;
    for (const std::string integrator : {"filtered", "reference"}) {
        SCOPED_TRACE(integrator);
        const std::string out = dir / (integrator + ".exr");
        const test::CliResult run =
            test::cli(test::with(furnace(integrator, out), {"--errors", "--seed", "3", "--json"}));
        ASSERT_CLI_OK(run);
        const json report = run.json();
        EXPECT_EQ(report.at("light"), "uniform");
        EXPECT_TRUE(report.at("light_phi_deg").is_null());
        EXPECT_EQ(report.at("spp"), 64);
        EXPECT_EQ(report.at("seed"), 3);
        EXPECT_GT(report.at("standard_error").get<double>(), 0.0);
        EXPECT_TRUE(report.at("verdicts").is_null());
        EXPECT_EQ(run.err.find("--spp has no effect"), std::string::npos) << run.err;
        EXPECT_EQ(run.err.find("--errors has no effect"), std::string::npos) << run.err;

        test::Image image;
        ASSERT_SMX_OK(smx_image_read_exr(out.c_str(), image.out()));
        EXPECT_NE(smx_image_errors(image), nullptr);
        EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.light"), "uniform");
        EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.integrator"), integrator.c_str());
        EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.spp"), "64");
        EXPECT_NE(smx_image_get_attribute(image, "slopemix.standard_error"), nullptr);
        EXPECT_GT(test::pixels(image).at(2, 6)[0], 0.1f); // lit from everywhere
        EXPECT_GT(test::pixels(image).at(13, 6)[0], 0.1f);
    }
}

TEST(CliUniform, TargetErrorAndDefaults) {
    const test::TempDir dir;
    Arguments by_error = test::with(furnace("filtered", dir / "a.exr"), {"--target-error", "0.01", "--json"});
    const test::CliResult run = test::cli(by_error);
    ASSERT_CLI_OK(run);
    EXPECT_LE(run.json().at("standard_error").get<double>(), 0.01);
    const test::CliResult usual =
        test::cli({"render", "builtin:conductor", "--integrator", "reference", "--alpha", "0.5,0.5", "--light",
                   "uniform", "--res", "8", "--out", dir / "b.exr", "--json"});
    ASSERT_CLI_OK(usual);
    EXPECT_EQ(usual.json().at("spp"), 4096);
}

TEST(CliUniform, WhatTakesOneDirectionRefuses) {
    const test::TempDir dir;
    const Arguments filtered = furnace("filtered", dir / "a.exr"), reference = furnace("reference", dir / "a.exr");
    EXPECT_CLI_FAILS(2, "--widening-order: auto takes no uniform light",
                     test::with(filtered, {"--widening-order", "auto"}));
    EXPECT_CLI_FAILS(2, "--sampler: the grid takes no uniform light", test::with(reference, {"--sampler", "grid"}));
    EXPECT_CLI_FAILS(2, "--errors", test::with(test::replaced(filtered, "--spp", "24"), {"--errors"}));
    EXPECT_CLI_FAILS(2, "--light",
                     {"render", "builtin:conductor", "--alpha", "0.5,0.5", "--light", "uniform", "--max-error", "0.1",
                      "--out", dir / "a.exr"});
    EXPECT_CLI_FAILS(2, "--light", {"effects", "builtin:conductor", "--alpha", "0.5,0.5", "--light", "uniform"});
    EXPECT_CLI_FAILS(2, "--light", test::replaced(filtered, "--light", "everywhere"));
    EXPECT_TRUE(dir.names().empty());
}
