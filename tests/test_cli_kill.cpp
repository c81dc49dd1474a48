// fit, sheet and tradeoff, killed at moments drawn at random until they are done: what is finished is whole at any
// moment, and in the end all is as if nothing had happened.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>

#include "cli.h"
#include "random.h"
#include "results.h"
#include "small_runs.h"
#include "whole_files.h"

using Clock = std::chrono::steady_clock;

namespace {

using Arguments = std::vector<std::string>;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Three quick fits, two at a time, and their pictures.
Arguments fit(const test::TempDir &out) {
    return {"fit",
            "analytic:ggx,alpha=0.1,f0=0.5",
            "--model",
            "shared",
            "analytic:beckmann,alpha=0.3,f0=1",
            "builtin:conductor",
            "--lobes",
            "2",
            "--jobs",
            "2",
            "--plot",
            "--resume",
            "--out",
            out.path()};
}

Arguments sheet(const test::TempDir &out) {
    return {"sheet", "builtin:conductor", "--res", "16",    "--spp",    "1024",    "--radii",
            "0.1",   "--lobes",           "1,2",   "--out", out.path(), "--resume"};
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
        test::expect_whole_files(dir);
        if (result.status == 0) return kills;
        EXPECT_EQ(result.status, -1) << result.err;
        if (testing::Test::HasFailure()) return kills;
    }
}

// One file of each kind, cut: the reader of its kind must notice. Where a CSV's line ends nobody could.
void expect_cuts_are_seen(const test::TempDir &dir, const std::set<std::string> &kinds) {
    std::set<std::string> cut;
    for (const std::string &name : dir.names()) {
        if (!cut.insert(std::filesystem::path(name).extension()).second) continue;
        const std::string whole = test::read_file(dir / name);
        for (const std::size_t size : {std::size_t{0}, whole.size() / 3, whole.size() - 8}) {
            test::write_file(dir / name, whole.substr(0, size));
            EXPECT_NE(test::fault_of_file(dir / name), "") << name << " of " << size << " bytes";
        }
    }
    EXPECT_EQ(cut, kinds);
}

void expect_survives_kills(const char *what, test::Command command, const std::set<std::string> &kinds,
                           int most_kills) {
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
    expect_cuts_are_seen(whole, kinds);
}

} // namespace

TEST(CliKill, Fit) { expect_survives_kills("fit", fit, {".csv", ".json", ".svg"}, 3); }

TEST(CliKill, Tradeoff) {
    expect_survives_kills("tradeoff", test::small_tradeoff, {".csv", ".exr", ".json", ".svg"}, 4);
}

TEST(CliKill, Sheet) { expect_survives_kills("sheet", sheet, {".exr", ".json", ".png"}, 4); }
