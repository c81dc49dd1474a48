// slopemix sheet --resume: what a killed sheet leaves, what goes on from there, and what is refused.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>

#include "cli.h"
#include "files.h"
#include "support.h"

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

using Arguments = std::vector<std::string>;

// 60 images, about a second: time enough for a signal among them.
Arguments sheet(const std::string &out, const Arguments &more = {}) {
    return test::with(
        {"sheet", "builtin:two-layer", "--out", out, "--res", "32", "--radii", "0.1,0.3", "--lobes", "1,2"}, more);
}
const Arguments samples{"--spp", "4096"};

// Ends a sheet by `signal` once this image is there.
test::CliResult interrupt(const Arguments &arguments, const std::string &image, int signal = SIGKILL) {
    test::CliSetting setting;
    setting.signal = signal;
    setting.signal_when = [&] { return test::exists(image); };
    return test::cli(arguments, setting);
}

bool is_image(const std::string &name) { return name.ends_with(".exr"); }

std::map<std::string, fs::file_time_type> times_of_images(const test::TempDir &dir) {
    std::map<std::string, fs::file_time_type> times;
    for (const std::string &name : dir.names())
        if (is_image(name)) times[name] = fs::last_write_time(dir / name);
    return times;
}

json journal_of(const test::TempDir &dir) { return json::parse(test::read_file(dir / "sheet.partial.json")); }
json document_of(const test::TempDir &dir) { return json::parse(test::read_file(dir / "sheet.json")); }

// All but times, and what tells that a sheet was interrupted.
json figures(json document) {
    for (const char *key :
         {"total_seconds", "build_seconds", "reference_seconds", "seconds_per_reference_sample", "kept_images"})
        EXPECT_EQ(document.erase(key), 1u) << key;
    for (const char *list : {"images", "fits"})
        for (json &item : document.at(list)) item.erase("seconds");
    return document;
}

void expect_same_sheet(const test::TempDir &a, const test::TempDir &b) {
    ASSERT_EQ(a.names(), b.names());
    for (const std::string &name : a.names())
        if (name != "sheet.json") {
            EXPECT_TRUE(test::read_file(a / name) == test::read_file(b / name)) << name;
        }
    EXPECT_EQ(figures(document_of(a)), figures(document_of(b)));
}

void flip_last_byte(const std::string &file) {
    std::string bytes = test::read_file(file);
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    test::write_file(file, bytes);
}

std::map<std::string, std::string> contents(const test::TempDir &dir) {
    std::map<std::string, std::string> files;
    for (const std::string &name : dir.names()) files[name] = test::read_file(dir / name);
    return files;
}

// Flags that change the images or which there are, and the setting that is then another.
struct Change {
    Arguments flags;
    const char *setting;
};
const std::vector<Change> changes = {{{"--spp", "4098"}, "spp"},
                                     {{"--spp", "4096", "--sampler", "sobol"}, "sampler"},
                                     {{"--target-error", "0.01"}, "spp"},
                                     {{"--spp", "4096", "--seed", "1"}, "seed"},
                                     {{"--spp", "4096", "--lookup", "nearest"}, "lookup"},
                                     {{"--spp", "4096", "--g", "separable"}, "g = "},
                                     {{"--spp", "4096", "--grade", "fast"}, "grade"},
                                     {{"--spp", "4096", "--model", "both"}, "model"}};

void expect_refused(const test::TempDir &dir) {
    test::cli(sheet(dir.path(), {"--spp", "4098", "--resume"})); // takes away what a killed run left
    const auto before = contents(dir);
    for (const Change &change : changes)
        EXPECT_CLI_FAILS(1, "made with " + std::string(change.setting),
                         sheet(dir.path(), test::with(change.flags, {"--resume"})));
    const Arguments resume = sheet(dir.path(), test::with(samples, {"--resume"}));
    EXPECT_CLI_FAILS(1, "made with resolution = [32,32], and this run has [33,32]",
                     test::replaced(resume, "--res", "33x32"));
    EXPECT_CLI_FAILS(1, "made with lobes", test::replaced(resume, "--lobes", "2,1"));
    EXPECT_CLI_FAILS(1, "made with radii", test::replaced(resume, "--radii", "0.1,0.4"));
    EXPECT_CLI_FAILS(1, "made with sha256", test::replaced(resume, "sheet", "builtin:conductor"));
    EXPECT_TRUE(contents(dir) == before);
}

} // namespace

TEST(CliResume, EqualsAnUninterruptedSheet) {
    const test::TempDir whole;
    ASSERT_CLI_OK(test::cli(sheet(whole.path(), samples)));
    EXPECT_EQ(document_of(whole).at("kept_images"), 0);
    // Early, and when the images that set the exposures are finished.
    for (const auto &[signal, image] : {std::pair{SIGKILL, "1.2.5.exr"}, {SIGINT, "3.2.2.exr"}}) {
        SCOPED_TRACE(signal);
        const test::TempDir dir;
        const test::CliResult first = interrupt(sheet(dir.path(), samples), dir / image, signal);
        ASSERT_EQ(first.status, signal == SIGKILL ? -1 : 1) << first.err;
        if (signal != SIGKILL) {
            EXPECT_NE(first.err.find("with --resume the same command goes on"), std::string::npos) << first.err;
        }
        EXPECT_FALSE(test::exists(dir / "sheet.json") || test::exists(dir / "sheet.png"));
        const std::size_t finished = journal_of(dir).at("items").size();
        ASSERT_GE(finished, 14u); // the one that was seen may not be listed yet
        ASSERT_LT(finished, 60u);
        const auto before = times_of_images(dir);
        test::write_file(dir / ".1.1.2.exr.4711.tmp", "left by a run that was killed");
        test::write_file(dir / ".1.1.2.exr.mine.tmp", "not ours");

        const test::CliResult second = test::cli(sheet(dir.path(), test::with(samples, {"--resume", "--json"})));
        ASSERT_CLI_OK(second);
        EXPECT_EQ(second.json().at("kept_images"), finished);
        const auto after = times_of_images(dir);
        std::size_t untouched = 0;
        for (const auto &[name, time] : before) untouched += after.at(name) == time;
        EXPECT_EQ(untouched, finished);
        EXPECT_TRUE(fs::remove(dir / ".1.1.2.exr.mine.tmp"));
        expect_same_sheet(dir, whole);
    }
}

TEST(CliResume, OtherSettingsAreRefused) {
    const test::TempDir dir;
    ASSERT_EQ(interrupt(sheet(dir.path(), samples), dir / "1.1.3.exr").status, -1);
    expect_refused(dir);
    ASSERT_CLI_OK(test::cli(sheet(dir.path(), test::with(samples, {"--resume"}))));
    EXPECT_FALSE(test::exists(dir / "sheet.partial.json"));
    json document = document_of(dir);
    document["version"] = "0.0.0";
    test::write_file(dir / "sheet.json", document.dump());
    EXPECT_CLI_FAILS(1, "made with version = \"0.0.0\"", sheet(dir.path(), test::with(samples, {"--resume"})));
    document["version"] = smx_version();
    document["seed"] = 7;
    test::write_file(dir / "sheet.json", document.dump());
    EXPECT_CLI_FAILS(1, "made with seed = 7, and this run has 0", sheet(dir.path(), test::with(samples, {"--resume"})));
}

TEST(CliResume, DamageIsNoticed) {
    const test::TempDir whole, dir;
    const Arguments resume = sheet(dir.path(), test::with(samples, {"--resume"}));
    ASSERT_CLI_OK(test::cli(sheet(whole.path(), samples)));
    ASSERT_EQ(interrupt(sheet(dir.path(), samples), dir / "1.1.6.exr").status, -1);

    const std::string journal = test::read_file(dir / "sheet.partial.json");
    std::string other = journal;
    const std::size_t digit = other.find_first_of("0123456789", other.find("\"kernel_seconds\"")) + 3;
    other[digit] = other[digit] == '5' ? '6' : '5';
    for (const std::string &bad : {other, journal.substr(0, journal.size() / 2), std::string(), std::string("[]")}) {
        test::write_file(dir / "sheet.partial.json", bad);
        EXPECT_CLI_FAILS(1, "damaged", resume);
        EXPECT_EQ(test::read_file(dir / "sheet.partial.json"), bad);
    }
    test::write_file(dir / "sheet.partial.json", R"({"format": "another"})");
    EXPECT_CLI_FAILS(1, "slopemix-journal", resume);
    test::write_file(dir / "sheet.partial.json", journal);

    const std::size_t finished = journal_of(dir).at("items").size();
    flip_last_byte(dir / "1.1.2.exr"); // a reference
    fs::remove(dir / "1.1.4.exr");
    const test::CliResult run = test::cli(test::with(resume, {"--json"}));
    ASSERT_CLI_OK(run);
    for (const char *name : {"1.1.2.exr is not", "1.1.4.exr is not"})
        EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
    EXPECT_EQ(run.json().at("kept_images"), finished - 2);
    expect_same_sheet(dir, whole);
}

TEST(CliResume, WithoutItASheetBeginsAnew) {
    const test::TempDir whole, dir;
    ASSERT_CLI_OK(test::cli(sheet(whole.path(), samples)));
    const Arguments other = sheet(dir.path(), {"--spp", "256"});
    ASSERT_CLI_OK(test::cli(other));
    const std::string earlier = test::read_file(dir / "3.2.10.exr");

    // The first image that is replaced takes the description of the others away.
    const auto before = times_of_images(dir);
    test::CliSetting setting;
    setting.signal = SIGKILL;
    setting.signal_when = [&] { return fs::last_write_time(dir / "1.1.3.exr") != before.at("1.1.3.exr"); };
    ASSERT_EQ(test::cli(sheet(dir.path(), samples), setting).status, -1);
    EXPECT_FALSE(test::exists(dir / "sheet.json") || test::exists(dir / "sheet.png"));
    EXPECT_TRUE(test::read_file(dir / "3.2.10.exr") == earlier);
    EXPECT_LT(journal_of(dir).at("items").size(), 60u);

    const test::CliResult run = test::cli(sheet(dir.path(), test::with(samples, {"--json"})));
    ASSERT_CLI_OK(run);
    EXPECT_NE(run.err.find("sheet.partial.json is of an interrupted sheet: beginning anew"), std::string::npos)
        << run.err;
    EXPECT_EQ(run.json().at("kept_images"), 0);
    expect_same_sheet(dir, whole);
}

TEST(CliResume, AWholeSheetStays) {
    const test::TempDir dir;
    const Arguments small = sheet(dir.path(), {"--spp", "64", "--resume"});
    const test::CliResult first = test::cli(small);
    ASSERT_CLI_OK(first);
    EXPECT_NE(first.err.find("nothing to resume"), std::string::npos) << first.err;
    const auto before = contents(dir);
    const auto times = times_of_images(dir);
    EXPECT_NE(test::cli(small).out.find("nothing to resume"), std::string::npos);
    EXPECT_EQ(test::cli(test::with(small, {"--json"})).out, before.at("sheet.json"));
    EXPECT_TRUE(contents(dir) == before);
    EXPECT_EQ(times_of_images(dir), times);

    flip_last_byte(dir / "1.1.2.exr");
    EXPECT_CLI_FAILS(1, "1.1.2.exr is not the image", small);
    fs::remove(dir / "1.1.2.exr");
    EXPECT_CLI_FAILS(1, "1.1.2.exr is not the image", small);
    json document = json::parse(before.at("sheet.json"));
    document["images"] = {1};
    for (const std::string &damaged : {document.dump(), std::string("{")}) {
        test::write_file(dir / "sheet.json", damaged);
        EXPECT_CLI_FAILS(1, "damaged", small);
    }
}

TEST(CliResume, AFolderHasOneRun) {
    const test::TempDir dir;
    const int folder = open(dir.path().c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(flock(folder, LOCK_EX), 0);
    EXPECT_CLI_FAILS(1, "another run is at work in " + dir.path(), sheet(dir.path(), samples));
    EXPECT_TRUE(dir.names().empty());
    EXPECT_CLI_FAILS(1, "another run is at work in " + dir.path(), sheet(dir.path(), {"--only", "1.1.1"}));
    ASSERT_EQ(flock(folder, LOCK_SH), 0); // as other calls with --only have it
    EXPECT_CLI_FAILS(1, "another run is at work in " + dir.path(), sheet(dir.path(), samples));
    ASSERT_CLI_OK(test::cli(sheet(dir.path(), {"--spp", "16", "--only", "1.1.1"})));
    close(folder);
}
