// Disks that are full or cannot be written, and two runs in one folder: what was finished is intact, the message says
// what happened, and the same command goes on once there is room.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <thread>

#include "cli.h"
#include "mounts.h"
#include "results.h"
#include "support.h"

namespace {

using Arguments = std::vector<std::string>;

constexpr std::size_t kilobyte = 1024, room = 64 * kilobyte * kilobyte;

Arguments fit(const test::TempDir &out) {
    return {"fit",
            "analytic:ggx,alpha=0.2,f0=0.5",
            "analytic:lambert,albedo=0.5",
            "--model",
            "shared",
            "--lobes",
            "2",
            "--jobs",
            "1",
            "--out",
            out.path()};
}

Arguments sheet(const test::TempDir &out) {
    return {"sheet", "builtin:conductor", "--res", "24",    "--spp",    "64",      "--radii",
            "0.1",   "--lobes",           "1",     "--out", out.path(), "--resume"};
}

Arguments render(const std::string &out) {
    return {"render", "builtin:conductor", "--integrator", "filtered", "--light",
            "0",      "--alpha",           "0.1,0.1",      "--out",    out};
}

class CliDisk : public testing::Test {
  protected:
    void SetUp() override {
        if (!test::can_mount()) GTEST_SKIP() << "this process may not mount; root may";
    }
};

// On a disk too small the command fails and says so; with room it ends as it would have.
void expect_goes_on(Arguments (*command)(const test::TempDir &), std::size_t size) {
    const test::TempDir whole, dir;
    ASSERT_CLI_OK(test::cli(command(whole)));
    test::SmallDisk disk(dir.path(), size);
    const test::CliResult full = test::cli(command(dir));
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
    EXPECT_NE(full.err.find("cannot write " + dir.path()), std::string::npos) << full.err;
    for (const std::string &name : dir.names()) EXPECT_FALSE(name.starts_with(".")) << name << " is left";
    const auto finished = test::results_in(dir); // all of them can be read
    EXPECT_LT(finished.size(), whole.names().size());

    disk.resize(room);
    ASSERT_CLI_OK(test::cli(command(dir)));
    const auto wanted = test::results_in(whole), got = test::results_in(dir);
    ASSERT_EQ(dir.names(), whole.names());
    for (const auto &[name, content] : wanted) EXPECT_TRUE(got.at(name) == content) << name;
}

} // namespace

TEST_F(CliDisk, FullUnderAFit) { expect_goes_on(fit, 24 * kilobyte); }

TEST_F(CliDisk, FullUnderASheet) { expect_goes_on(sheet, 80 * kilobyte); }

// At every size that is too small, the file that was there stays.
TEST_F(CliDisk, FullUnderAnImage) {
    const test::TempDir dir, elsewhere;
    ASSERT_CLI_OK(test::cli(render(elsewhere / "image.exr")));
    const std::string whole = test::read_file(elsewhere / "image.exr");
    const std::size_t page = 4 * kilobyte, pages = (whole.size() + page - 1) / page;
    for (const std::size_t size : {page * 2, page * pages / 2, page * pages}) { // one page is the earlier file's
        const test::SmallDisk disk(dir.path(), size);
        test::write_file(dir / "image.exr", "earlier");
        EXPECT_CLI_FAILS(1, "No space left on device", render(dir / "image.exr"));
        EXPECT_EQ(test::read_file(dir / "image.exr"), "earlier");
        EXPECT_EQ(dir.names(), Arguments{"image.exr"});
    }
}

TEST_F(CliDisk, ReadOnlyFoldersAreNamed) {
    const test::TempDir dir;
    test::SmallDisk disk(dir.path(), room);
    ASSERT_CLI_OK(test::cli(sheet(dir)));
    const auto before = test::results_in(dir);
    disk.make_read_only();
    Arguments anew = sheet(dir);
    anew.pop_back();
    for (const Arguments &arguments : {anew, fit(dir), render(dir / "image.exr"),
                                       Arguments{"synth", "builtin:conductor", "--out", dir / "table.binary"}})
        EXPECT_CLI_FAILS(1, "Read-only file system", arguments);
    EXPECT_TRUE(test::results_in(dir) == before);
}

TEST(CliFolder, AFitHasItsFolderToItself) {
    const test::TempDir dir;
    const int folder = open(dir.path().c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(flock(folder, LOCK_EX), 0);
    EXPECT_CLI_FAILS(1, "another run is at work in " + dir.path(), fit(dir));
    EXPECT_TRUE(dir.names().empty());
    close(folder);
    test::write_file(dir / ".lambert,albedo=0.5.json.4711.tmp", "left by a run that was killed");
    ASSERT_CLI_OK(test::cli(fit(dir)));
    for (const std::string &name : dir.names()) EXPECT_FALSE(name.starts_with(".")) << name;
}

// One of them works, or one after the other.
TEST(CliFolder, TwoRunsAtOnceDoNotMix) {
    const test::TempDir whole, dir;
    ASSERT_CLI_OK(test::cli(fit(whole)));
    test::CliResult results[2];
    {
        std::vector<std::jthread> runs;
        for (test::CliResult &result : results) runs.emplace_back([&] { result = test::cli(fit(dir)); });
    }
    EXPECT_TRUE(results[0].status == 0 || results[1].status == 0) << results[0].err << results[1].err;
    for (const test::CliResult &result : results) {
        if (result.status == 0) continue;
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("another run is at work"), std::string::npos) << result.err;
    }
    EXPECT_TRUE(test::results_in(dir) == test::results_in(whole));
}
