// slopemix render --max-error, --max-seconds: what is picked, what is said, what is refused.
#include <gtest/gtest.h>

#include "cli.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments render(const std::string &out, const Arguments &more) {
    const Arguments base = {
        "render", "builtin:two-layer", "--alpha", "0.3,0.2", "--light", "20", "--res", "48", "--out", out};
    return test::with(base, more);
}

} // namespace

TEST(CliChoose, RendersWhatItPicked) {
    const test::TempDir dir;
    const std::string out = dir / "image.exr";
    const test::CliResult run = test::cli(render(out, {"--max-error", "0.03", "--json"}));
    ASSERT_CLI_OK(run);
    const json document = run.json(), choice = document.at("choice"), picked = choice.at("picked");
    EXPECT_LE(picked.at("error").get<double>(), 0.03);
    for (const char *same : {"integrator", "model", "lobes", "widening_order", "sampler", "spp"})
        EXPECT_EQ(document.at(same), picked.at(same)) << same;
    EXPECT_GT(choice.at("fit_seconds").get<double>(), 0.0);
    EXPECT_GT(choice.at("tried").size(), 1u);
    test::Image image;
    EXPECT_SMX_OK(smx_image_read_exr(out.c_str(), image.out()));
}

TEST(CliChoose, TextHasThePrediction) {
    const test::TempDir dir;
    const test::CliResult run =
        test::cli(render(dir / "image.exr", {"--max-error", "0.1", "--model", "per-lobe", "--lobes", "2"}));
    ASSERT_CLI_OK(run);
    for (const char *said : {"picked", "as predicted", "next cheaper", "ways tried on", "fits"})
        EXPECT_NE(run.out.find(said), std::string::npos) << said << " in " << run.out;
}

TEST(CliChoose, ChoosesFromFiles) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli({"fit", "builtin:two-layer", "--out", dir.path()}));
    const std::string file = dir / "two-layer.json";
    const test::CliResult given =
        test::cli(render(dir / "a.exr", {"--max-seconds", "0.02", "--material", file, "--json"}));
    ASSERT_CLI_OK(given);
    EXPECT_LE(given.json().at("choice").at("picked").at("seconds").get<double>(), 0.02);
    EXPECT_EQ(given.json().at("choice").at("fit_seconds").get<double>(), 0.0);

    Arguments alone = render(dir / "b.exr", {"--max-error", "0.5", "--json"});
    alone[1] = file;
    const test::CliResult filtered = test::cli(alone);
    ASSERT_CLI_OK(filtered);
    EXPECT_EQ(filtered.json().at("integrator"), "filtered");
    EXPECT_TRUE(filtered.json().at("choice").at("pilot_error").is_null());
    EXPECT_CLI_FAILS(1, "the least that can be reached", test::replaced(alone, "--max-error", "0.00001"));
}

TEST(CliChoose, RefusesFlagsThatItAnswers) {
    const test::TempDir dir;
    const std::string out = dir / "image.exr";
    for (const Arguments &answered : {Arguments{"--integrator", "reference"},
                                      {"--spp", "64"},
                                      {"--target-error", "0.1"},
                                      {"--sampler", "mis"},
                                      {"--widening-order", "1"},
                                      {"--widening-tolerance", "0.1"}}) {
        EXPECT_CLI_FAILS(2, answered[0], render(out, test::with({"--max-error", "0.1"}, answered)));
        EXPECT_CLI_FAILS(2, answered[0], render(out, test::with({"--max-seconds", "1"}, answered)));
    }
    EXPECT_CLI_FAILS(2, "--max-error", render(out, {"--max-error", "0.1", "--max-seconds", "1"}));
    EXPECT_CLI_FAILS(2, "--integrator", render(out, {}));
    EXPECT_CLI_FAILS(2, "--material", render(out, {"--integrator", "reference", "--material", "x.json"}));
    EXPECT_CLI_FAILS(2, "--errors", render(out, {"--max-error", "0.1", "--errors"}));
    EXPECT_CLI_FAILS(2, "'2'", render(out, {"--max-error", "2"}));
    const test::CliResult noted = test::cli(render(out, {"--max-error", "0.5", "--bounces", "2"}));
    ASSERT_CLI_OK(noted);
    EXPECT_NE(noted.err.find("--bounces has no effect"), std::string::npos) << noted.err;
}
