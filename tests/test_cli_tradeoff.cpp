// slopemix tradeoff: what is swept, what is written, what goes on from where, and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "cli.h"
#include "close.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments tradeoff(const test::TempDir &out, const Arguments &more = {}) {
    return test::with({"tradeoff", "builtin:conductor", "--res", "16", "--samples", "64", "--lobes", "1",
                       "--widening-order", "0,2", "--out", out.path()},
                      more);
}

const json &point_named(const json &report, const std::string &name) {
    for (const json &point : report.at("points"))
        if (point.at("name") == name) return point;
    throw std::out_of_range("no point " + name);
}

json report_of(const test::TempDir &dir) { return json::parse(test::read_file(dir / "tradeoff.json")); }

// What does not depend on times.
std::vector<json> errors_of(const json &report) {
    std::vector<json> errors;
    for (json point : report.at("points")) {
        for (const char *timed : {"seconds", "kernel_seconds", "ns_per_evaluation", "pareto"}) point.erase(timed);
        errors.push_back(point);
    }
    return errors;
}

} // namespace

TEST(CliTradeoff, SweepsEveryMethodAndWritesItsFiles) {
    const test::TempDir dir;
    const test::CliResult run = test::cli(tradeoff(dir));
    ASSERT_CLI_OK(run);
    EXPECT_EQ(dir.names(), (std::vector<std::string>{"tradeoff.csv", "tradeoff.json", "tradeoff.svg", "truth.exr"}));
    const json report = report_of(dir);
    std::vector<std::string> names;
    for (const json &point : report.at("points")) names.push_back(point.at("name"));
    EXPECT_EQ(names, (std::vector<std::string>{"grid 1",
                                               "grid 4",
                                               "grid 16",
                                               "grid 64",
                                               "sobol 1",
                                               "sobol 4",
                                               "sobol 16",
                                               "sobol 64",
                                               "mis 2",
                                               "mis 4",
                                               "mis 16",
                                               "mis 64",
                                               "geometric 16",
                                               "geometric 64",
                                               "shared N=1 order 0",
                                               "shared N=1 order 2",
                                               "per-lobe N=1 order 0",
                                               "per-lobe N=1 order 2",
                                               "mis 64 fast",
                                               "mis 64 double",
                                               "mis 64 separable",
                                               "mis 64 no-masking",
                                               "mis 64 no-shadowing",
                                               "per-lobe N=1 order 0 fast",
                                               "per-lobe N=1 order 0 double",
                                               "per-lobe N=1 order 0 separable",
                                               "per-lobe N=1 order 0 no-masking",
                                               "per-lobe N=1 order 0 no-shadowing",
                                               "per-lobe N=1 order 0 no-fresnel",
                                               "per-lobe N=1 order 0 no-lobe-color",
                                               "per-lobe N=1 order 0 effects-auto"}));
    for (const std::string &name : names) {
        EXPECT_NE(test::read_file(dir / "tradeoff.csv").find('\n' + name + ','), std::string::npos) << name;
        const json &point = point_named(report, name);
        EXPECT_GE(point.at("runs"), 5) << name;
        EXPECT_GT(point.at("kernel_seconds").at("median").get<double>(), 0.0) << name;
        EXPECT_GE(point.at("seconds").at("median"), point.at("kernel_seconds").at("low")) << name;
    }
    for (const char *text : {"cheapest for its error", "measured table", "fitted base", "errors are told"})
        EXPECT_NE(run.out.find(text), std::string::npos) << "no \"" << text << "\" in\n" << run.out;
    const std::string svg = test::read_file(dir / "tradeoff.svg");
    for (const char *text : {"</svg>", "data:image/png", "Pareto set", "order 2", "by samples"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
}

// The truth, rendered here again: the errors in the report are those of the API's images against it.
TEST(CliTradeoff, ErrorsAreThoseAgainstTheTruth) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(tradeoff(dir, {"--methods", "mis,per-lobe", "--light", "30", "--alpha", "0.3,0.1"})));
    const json report = report_of(dir);
    test::Image truth;
    ASSERT_SMX_OK(smx_image_read_exr((dir / "truth.exr").c_str(), truth.out()));
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:conductor", brdf.out()));
    const smx_scene scene = test::make_scene(16, 16, test::radians(30.0), {0.3, 0.1, 0.0, 0.0, 0.0});

    const test::Material material = test::fit(test::make_density(brdf, SMX_MASKING_COINCIDES), 1, SMX_MODEL_PER_LOBE);
    const double filter_error = test::relrmse(test::render_filtered(material, scene), truth);
    const json &filter = point_named(report, "per-lobe N=1 order 0");
    EXPECT_CLOSE(filter.at("relrmse").get<double>(), filter_error, 1e-6, 0.0);
    EXPECT_TRUE(filter.at("noise").is_null());

    constexpr uint32_t all = SMX_EFFECT_MASKING | SMX_EFFECT_SHADOWING | SMX_EFFECT_HEIGHT_CORRELATION |
                             SMX_EFFECT_FRESNEL | SMX_EFFECT_LOBE_COLOR | SMX_EFFECT_ANISOTROPY | SMX_EFFECT_MEAN_SLOPE;
    for (const auto &[word, effect] :
         std::vector<std::pair<std::string, smx_effect>>{{"no-masking", SMX_EFFECT_MASKING},
                                                         {"no-fresnel", SMX_EFFECT_FRESNEL},
                                                         {"no-anisotropy", SMX_EFFECT_ANISOTROPY}}) {
        smx_render_options options = SMX_RENDER_OPTIONS_INIT;
        options.effects = all & ~uint32_t{effect};
        test::Image without;
        ASSERT_SMX_OK(smx_render_filtered(test::context(), material, &scene, &options, without.out(), nullptr));
        const double error = test::relrmse(without, truth);
        EXPECT_CLOSE(point_named(report, "per-lobe N=1 order 0 " + word).at("relrmse").get<double>(), error, 1e-6, 0.0);
        EXPECT_NE(error, filter_error) << word;
    }

    const json &sampled = point_named(report, "mis 16");
    const auto runs = sampled.at("runs").get<uint64_t>();
    double squares = 0.0;
    for (uint64_t run = 1; run <= runs; ++run) {
        smx_render_options options = test::make_options(16, run);
        options.sampler = SMX_SAMPLER_MIS;
        squares += std::pow(test::relrmse(test::render_reference(brdf, scene, options), truth), 2);
    }
    const double error = std::sqrt(squares / static_cast<double>(runs));
    EXPECT_CLOSE(sampled.at("relrmse").get<double>(), error, 1e-6, 0.0);
    // Without a bias, all of it is noise, but for what a few runs know of it.
    EXPECT_TRUE(sampled.at("bias").is_null());
    EXPECT_CLOSE(sampled.at("noise").get<double>(), error, 0.5, 0.0);
}

TEST(CliTradeoff, TheTruthKnowsItsError) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(tradeoff(dir, {"--methods", "sobol,mis,shared"})));
    const json report = report_of(dir);
    const json &truth = report.at("truth");
    const double error = truth.at("standard_error");
    EXPECT_EQ(truth.at("samples"), 65536);
    EXPECT_GT(truth.at("agreement").get<double>(), 0.2);
    EXPECT_LT(truth.at("agreement").get<double>(), 3.0);
    EXPECT_CLOSE(truth.at("floor").get<double>(), 10.0 * error, 1e-12, 0.0);
    for (const json &point : report.at("points")) {
        EXPECT_EQ(point.at("at_floor"), point.at("relrmse").is_null());
        if (point.at("at_floor")) continue;
        EXPECT_GT(point.at("relrmse").get<double>(), 10.0 * error);
    }
}

TEST(CliTradeoff, GoesOnWhereItWasInterrupted) {
    const test::TempDir whole, cut;
    const Arguments lists = {"--methods", "sobol,mis,per-lobe"};
    ASSERT_CLI_OK(test::cli(tradeoff(whole, lists)));
    test::CliSetting setting;
    setting.signal = SIGINT;
    setting.signal_when = [&] {
        const std::string journal = cut / "tradeoff.partial.json";
        return test::exists(journal) && test::read_file(journal).find("sobol 16") != std::string::npos;
    };
    const test::CliResult interrupted = test::cli(tradeoff(cut, lists), setting);
    ASSERT_EQ(interrupted.status, 1) << interrupted.err;
    EXPECT_NE(interrupted.err.find("--resume"), std::string::npos) << interrupted.err;

    EXPECT_CLI_FAILS(1, "light_phi_deg", tradeoff(cut, test::with(lists, {"--resume", "--light", "45"})));
    ASSERT_CLI_OK(test::cli(tradeoff(cut, test::with(lists, {"--resume"}))));
    const json report = report_of(cut);
    EXPECT_GT(report.at("kept_points").get<int>(), 0);
    EXPECT_EQ(errors_of(report), errors_of(report_of(whole)));
    EXPECT_EQ(cut.names(), whole.names());
    const test::CliResult again = test::cli(tradeoff(cut, test::with(lists, {"--resume"})));
    ASSERT_CLI_OK(again);
    EXPECT_NE(again.out.find("nothing to resume"), std::string::npos) << again.out;
}

TEST(CliTradeoff, WithoutLightThereIsNoError) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(1, "black", tradeoff(dir, {"--light", "-90"}));
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliTradeoff, WrongUsageIsRefusedByName) {
    const test::TempDir dir;
    const std::vector<std::pair<std::string, Arguments>> bad{
        {"--methods", {"", "rays", "mis,", "mis,mis"}},
        {"--alpha", {"0,0", "0.1", "nan,0.1"}},
        {"--light", {"east"}},
    };
    for (const auto &[flag, values] : bad)
        for (const std::string &value : values) EXPECT_CLI_FAILS(2, flag, tradeoff(dir, {flag, value}));
    for (const auto &[flag, values] : std::vector<std::pair<std::string, Arguments>>{
             {"--lobes", {"0", "1,1", ""}}, {"--widening-order", {"9", "1,1"}}, {"--samples", {"0", "x"}}})
        for (const std::string &value : values) EXPECT_CLI_FAILS(2, flag, test::replaced(tradeoff(dir), flag, value));
    EXPECT_CLI_FAILS(2, "nothing to sweep",
                     test::replaced(tradeoff(dir, {"--methods", "geometric,mis"}), "--samples", "1"));
    EXPECT_CLI_FAILS(2, "paint.json", Arguments{"tradeoff", "paint.json", "--out", dir.path()});
    EXPECT_CLI_FAILS(1, "velvet", Arguments{"tradeoff", "builtin:velvet", "--out", dir.path()});
    EXPECT_CLI_FAILS(1, "/proc/none", Arguments{"tradeoff", "builtin:conductor", "--out", "/proc/none"});
    EXPECT_TRUE(dir.names().empty());
}
