// Disks that are full or cannot be written: what was finished is intact, the message says what happened, and the same
// command goes on once there is room.
#include <gtest/gtest.h>

#include "cli.h"
#include "mounts.h"
#include "results.h"
#include "small_runs.h"
#include "whole_files.h"

namespace {

using Arguments = std::vector<std::string>;

constexpr std::size_t kilobyte = 1024, room = 64 * kilobyte * kilobyte;

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
void expect_goes_on(test::Command command, std::size_t size) {
    const test::TempDir whole, dir;
    ASSERT_CLI_OK(test::cli(command(whole)));
    test::SmallDisk disk(dir.path(), size);
    const test::CliResult full = test::cli(command(dir));
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
    EXPECT_NE(full.err.find("cannot write " + dir.path()), std::string::npos) << full.err;
    for (const std::string &name : dir.names()) EXPECT_FALSE(name.starts_with(".")) << name << " is left";
    test::expect_whole_files(dir);
    EXPECT_LT(dir.names().size(), whole.names().size());

    disk.resize(room);
    ASSERT_CLI_OK(test::cli(command(dir)));
    const auto wanted = test::results_in(whole), got = test::results_in(dir);
    ASSERT_EQ(dir.names(), whole.names());
    for (const auto &[name, content] : wanted) EXPECT_TRUE(got.at(name) == content) << name;
}

} // namespace

TEST_F(CliDisk, FullUnderAFit) { expect_goes_on(test::small_fit, 24 * kilobyte); }

TEST_F(CliDisk, FullUnderASheet) { expect_goes_on(test::small_sheet, 80 * kilobyte); }

// There is no room for the truth, or only for the sweep without its chart.
TEST_F(CliDisk, FullUnderATradeoff) {
    for (const std::size_t size : {4 * kilobyte, 32 * kilobyte}) {
        SCOPED_TRACE(size);
        expect_goes_on(test::small_tradeoff, size);
    }
}

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
    ASSERT_CLI_OK(test::cli(test::small_sheet(dir)));
    const auto before = test::results_in(dir);
    disk.make_read_only();
    Arguments sheet = test::small_sheet(dir), tradeoff = test::small_tradeoff(dir);
    for (Arguments *resumed : {&sheet, &tradeoff}) resumed->pop_back();
    for (const Arguments &arguments : {sheet, tradeoff, test::small_fit(dir), render(dir / "image.exr"),
                                       Arguments{"synth", "builtin:conductor", "--out", dir / "table.binary"}})
        EXPECT_CLI_FAILS(1, "Read-only file system", arguments);
    EXPECT_TRUE(test::results_in(dir) == before);
}
