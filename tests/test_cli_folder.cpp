// Two runs in one folder at once: one of them works there, the other says so, and what is finished is as after one run.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <thread>

#include "cli.h"
#include "results.h"
#include "small_runs.h"
#include "whole_files.h"

namespace {

void expect_results_of_one_run(const test::TempDir &dir, const test::TempDir &one) {
    test::expect_whole_files(dir);
    EXPECT_EQ(dir.names(), one.names());
    EXPECT_TRUE(test::results_in(dir) == test::results_in(one));
}

// The first run stands still in the middle of its work, with `begun` finished, while the second one tries.
void expect_second_is_refused(test::Command command, const std::string &begun) {
    const test::TempDir one, dir;
    ASSERT_CLI_OK(test::cli(command(one)));
    bool has_met = false;
    test::CliSetting setting;
    setting.signal_when = [&] { return test::exists(dir / begun); };
    setting.meanwhile = [&] {
        has_met = true;
        const auto before = test::results_in(dir);
        EXPECT_CLI_FAILS(1, "another run is at work in " + dir.path(), command(dir));
        EXPECT_TRUE(test::results_in(dir) == before);
    };
    ASSERT_CLI_OK(test::cli(command(dir), setting));
    EXPECT_TRUE(has_met) << "the first run ended too soon";
    expect_results_of_one_run(dir, one);
}

// Begun at the same moment: one of them works, or one after the other.
void expect_no_mixture(test::Command command) {
    const test::TempDir one, dir;
    ASSERT_CLI_OK(test::cli(command(one)));
    test::CliResult results[2];
    {
        std::vector<std::jthread> runs;
        for (test::CliResult &result : results) runs.emplace_back([&] { result = test::cli(command(dir)); });
    }
    EXPECT_TRUE(results[0].status == 0 || results[1].status == 0) << results[0].err << results[1].err;
    for (const test::CliResult &result : results) {
        if (result.status == 0) continue;
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("another run is at work"), std::string::npos) << result.err;
    }
    expect_results_of_one_run(dir, one);
}

} // namespace

TEST(CliFolder, AFitHasItsFolderToItself) {
    const test::TempDir dir;
    const int folder = open(dir.path().c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(flock(folder, LOCK_EX), 0);
    EXPECT_CLI_FAILS(1, "another run is at work in " + dir.path(), test::small_fit(dir));
    EXPECT_TRUE(dir.names().empty());
    close(folder);
    test::write_file(dir / ".lambert,albedo=0.5.json.4711.tmp", "left by a run that was killed");
    ASSERT_CLI_OK(test::cli(test::small_fit(dir)));
    for (const std::string &name : dir.names()) EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST(CliFolder, ASecondFitIsRefused) { expect_second_is_refused(test::small_fit, "ggx,alpha=0.2,f0=0.5.json"); }
TEST(CliFolder, ASecondSheetIsRefused) { expect_second_is_refused(test::small_sheet, "sheet.partial.json"); }
TEST(CliFolder, ASecondTradeoffIsRefused) { expect_second_is_refused(test::small_tradeoff, "tradeoff.partial.json"); }

TEST(CliFolder, TwoFitsDoNotMix) { expect_no_mixture(test::small_fit); }
TEST(CliFolder, TwoSheetsDoNotMix) { expect_no_mixture(test::small_sheet); }
TEST(CliFolder, TwoTradeoffsDoNotMix) { expect_no_mixture(test::small_tradeoff); }
