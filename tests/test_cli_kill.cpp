// fit, sheet and tradeoff, killed at moments drawn at random until they are done: what is finished is whole at any
// moment, and in the end all is as if nothing had happened.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

#include "cli.h"
#include "random.h"
#include "results.h"
#include "support.h"

using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

using Arguments = std::vector<std::string>;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Four quick fits, two at a time.
Arguments fit(const test::TempDir &out) {
    return {"fit",
            "analytic:ggx,alpha=0.1,f0=0.5",
            "analytic:ggx,alpha=0.2,f0=0.5",
            "--model",
            "shared",
            "analytic:beckmann,alpha=0.3,f0=1",
            "builtin:conductor",
            "--lobes",
            "2",
            "--jobs",
            "2",
            "--resume",
            "--out",
            out.path()};
}

Arguments sheet(const test::TempDir &out) {
    return {"sheet", "builtin:conductor", "--res", "16",    "--spp",    "1024",    "--radii",
            "0.1",   "--lobes",           "1,2",   "--out", out.path(), "--resume"};
}

Arguments tradeoff(const test::TempDir &out) {
    return {"tradeoff",
            "builtin:conductor",
            "--res",
            "16",
            "--samples",
            "64",
            "--methods",
            "mis,shared",
            "--lobes",
            "1",
            "--out",
            out.path(),
            "--widening-order",
            "0",
            "--resume"};
}

bool is_temporary(const std::string &name) { return name.starts_with("."); }

// Whatever has a name of its own can be read.
void expect_whole_files(const test::TempDir &dir) {
    for (const std::string &name : dir.names()) {
        if (is_temporary(name)) continue;
        if (name.ends_with(".exr")) {
            test::Image image;
            EXPECT_SMX_OK(smx_image_read_exr((dir / name).c_str(), image.out())) << name;
        } else if (name.ends_with(".json")) {
            const json document = json::parse(test::read_file(dir / name), nullptr, false);
            ASSERT_TRUE(document.is_object()) << name;
            if (document.value("format", "") != "slopemix-material") continue;
            test::Material material;
            EXPECT_SMX_OK(smx_material_load((dir / name).c_str(), material.out())) << name;
        }
    }
}

// Runs it again and again, each time killed within `seconds`, until it ends by itself; how many times it was killed.
int run_killed(const Arguments &arguments, const test::TempDir &dir, double seconds, test::Random &random) {
    for (int kills = 0;; ++kills) {
        // Later and later, so that it ends.
        const double moment = random.uniform(0.0, seconds) * (1.0 + 0.1 * kills);
        test::CliSetting setting;
        setting.signal = SIGKILL;
        setting.signal_when = [moment, start = Clock::now()] { return seconds_since(start) > moment; };
        const test::CliResult result = test::cli(arguments, setting);
        expect_whole_files(dir);
        if (result.status == 0) return kills;
        EXPECT_EQ(result.status, -1) << result.err;
        if (testing::Test::HasFailure()) return kills;
    }
}

void expect_survives_kills(const char *what, Arguments (*command)(const test::TempDir &), int most_kills) {
    const test::TempDir whole;
    const auto start = Clock::now();
    ASSERT_CLI_OK(test::cli(command(whole)));
    const double seconds = seconds_since(start);
    const auto wanted = test::results_in(whole);
    test::Random random(83);
    for (int kills = 0; kills < most_kills;) {
        const test::TempDir dir;
        kills += run_killed(command(dir), dir, seconds, random);
        const auto got = test::results_in(dir);
        ASSERT_EQ(dir.names(), whole.names()) << what;
        for (const auto &[name, content] : wanted) EXPECT_TRUE(got.at(name) == content) << what << ", " << name;
    }
}

} // namespace

TEST(CliKill, Fit) { expect_survives_kills("fit", fit, 4); }

// Charts and Pareto set are of times, which no two runs have in common.
TEST(CliKill, Tradeoff) {
    const auto errors_in = [](const test::TempDir &dir) {
        std::vector<json> errors;
        const json report = json::parse(test::read_file(dir / "tradeoff.json"));
        for (const json &point : report.at("points"))
            errors.push_back({point.at("name"), point.at("relrmse"), point.at("noise"), point.at("widening")});
        return errors;
    };
    const test::TempDir whole;
    const auto start = Clock::now();
    ASSERT_CLI_OK(test::cli(tradeoff(whole)));
    const double seconds = seconds_since(start);
    test::Random random(84);
    for (int kills = 0; kills < 4;) {
        const test::TempDir dir;
        kills += run_killed(tradeoff(dir), dir, seconds, random);
        ASSERT_EQ(dir.names(), whole.names());
        EXPECT_EQ(errors_in(dir), errors_in(whole));
        EXPECT_EQ(test::read_file(dir / "truth.exr"), test::read_file(whole / "truth.exr"));
    }
}

TEST(CliKill, Sheet) { expect_survives_kills("sheet", sheet, 4); }
