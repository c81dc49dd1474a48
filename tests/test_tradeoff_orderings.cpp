// The quick sweep: orderings that hold on any machine, never a time by itself.
#include <gtest/gtest.h>

#include "cli.h"
#include "files.h"

using nlohmann::json;

namespace {

class TradeoffOrderings : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const test::TempDir dir;
        // 65536 samples too, for the last of the tests.
        const test::CliResult run =
            test::cli({"tradeoff", "builtin:two-layer", "--quick", "--samples", "65536", "--methods",
                       "grid,sobol,mis,shared,per-lobe", "--res", "64", "--json", "--out", dir.path()});
        ASSERT_CLI_OK(run);
        report_ = run.json();
    }

    static const json &point(const std::string &name) {
        for (const json &point : report_.at("points"))
            if (point.at("name") == name) return point;
        throw std::out_of_range("no point " + name);
    }
    static double error(const std::string &name) {
        const json &relrmse = point(name).at("relrmse");
        return relrmse.is_null() ? report_.at("truth").at("floor").get<double>() : relrmse.get<double>();
    }
    static double seconds(const std::string &name) { return point(name).at("kernel_seconds").at("median"); }

    static json report_;
};

json TradeoffOrderings::report_;

} // namespace

// Random points have 1/2; scrambled Sobol points up to 3/2 for a smooth integrand, which a table is not.
TEST_F(TradeoffOrderings, NoiseFallsWithSamples) {
    for (const json &sampler : report_.at("calibration").at("samplers")) {
        const double exponent = sampler.at("noise").at("p");
        EXPECT_GT(exponent, 0.45) << sampler;
        EXPECT_LT(exponent, 1.5) << sampler;
    }
    for (const char *sampler : {"grid", "sobol", "mis"})
        for (int samples = 4; samples < 4096; samples *= 16) {
            const std::string few = std::string(sampler) + ' ' + std::to_string(samples),
                              many = std::string(sampler) + ' ' + std::to_string(16 * samples);
            if (point(many).at("at_floor")) continue;
            EXPECT_LT(error(many), error(few)) << few;
        }
}

// Sixteen times the samples; a machine that is busy elsewhere has room for the rest.
TEST_F(TradeoffOrderings, SamplesCost) {
    for (const std::string sampler : {"grid", "sobol", "mis"})
        EXPECT_GT(seconds(sampler + " 65536") / seconds(sampler + " 4096"), 4.0) << sampler;
}

TEST_F(TradeoffOrderings, LobesWithTheirOwnCurvesAreCloser) {
    EXPECT_LT(error("per-lobe N=8 order 0"), error("shared N=1 order 0"));
    EXPECT_LT(error("per-lobe N=8 order 0"), error("per-lobe N=1 order 0"));
}

TEST_F(TradeoffOrderings, AnOrderTakesTheWideningAway) {
    EXPECT_LT(point("per-lobe N=8 order 3").at("widening"), point("per-lobe N=8 order 0").at("widening"));
    EXPECT_GT(seconds("per-lobe N=8 order 3"), seconds("per-lobe N=8 order 0"));
}

TEST_F(TradeoffOrderings, TheFilterIsAThousandTimesCheaper) {
    for (const char *sampler : {"grid 65536", "sobol 65536", "mis 65536"})
        EXPECT_GT(seconds(sampler) / seconds("per-lobe N=8 order 0"), 1000.0) << sampler;
}

TEST_F(TradeoffOrderings, TheHalvesOfTheTruthAgree) {
    EXPECT_LT(report_.at("truth").at("agreement").get<double>(), 3.0);
    EXPECT_GT(report_.at("truth").at("agreement").get<double>(), 1.0 / 3.0);
}
