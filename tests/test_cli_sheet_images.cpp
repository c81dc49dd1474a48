// slopemix sheet --only and --collect: images rendered by many calls, and the sheet of them.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <thread>

#include "cli.h"
#include "files.h"
#include "results.h"
#include "support.h"

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

using Arguments = std::vector<std::string>;

// 30 images: a geometry, three references, three times two filtered ones in each table.
Arguments sheet(const std::string &out, const Arguments &more = {}) {
    return test::with({"sheet", "builtin:conductor", "--out", out, "--res", "16", "--spp", "64", "--radii", "0.3",
                       "--lobes", "2", "--model", "both"},
                      more);
}

Arguments only(const std::string &out, const std::string &ids, const Arguments &more = {}) {
    return test::with(sheet(out, {"--only", ids}), more);
}

std::string row(int table) {
    const std::string begin = std::to_string(table) + ".1.";
    std::string ids = begin + "1";
    for (int column = 2; column <= 10; ++column) ids.append(",").append(begin).append(std::to_string(column));
    return ids;
}

void render_rows_at_once(const std::string &out) {
    std::vector<std::jthread> calls;
    for (const int table : {3, 1, 2, 1}) // one of them twice
        calls.emplace_back([=] {
            const test::CliResult run = test::cli(only(out, row(table)));
            EXPECT_EQ(run.status, 0) << run.err;
        });
}

std::map<std::string, std::string> bytes_of(const test::TempDir &dir) {
    std::map<std::string, std::string> files;
    for (const std::string &name : dir.names()) files[name] = test::read_file(dir / name);
    return files;
}

json document(const test::TempDir &dir, const std::string &name) { return json::parse(test::read_file(dir / name)); }

// The materials of the sheet above, fitted by `fit`.
Arguments fits(const test::TempDir &dir, const std::string &input) {
    Arguments flags;
    for (const char *model : {"shared", "per-lobe"}) {
        const std::string folder = dir / model;
        const test::CliResult run =
            test::cli({"fit", input, "--model", model, "--lobes", "2", "--out", folder, "--json"});
        EXPECT_EQ(run.status, 0) << run.err;
        flags = test::with(flags, {"--fit", run.json().at("materials")[0].at("file")});
    }
    return flags;
}

} // namespace

TEST(CliSheetImages, CollectedTheyAreTheWholeSheet) {
    const test::TempDir whole, dir;
    ASSERT_CLI_OK(test::cli(sheet(whole.path())));
    render_rows_at_once(dir.path());
    EXPECT_EQ(dir.names().size(), 60u); // image and record of each
    ASSERT_CLI_OK(test::cli(sheet(dir.path(), {"--collect"})));
    auto collected = test::results_in(dir);
    for (const auto &[name, content] : test::results_in(whole)) EXPECT_TRUE(collected.at(name) == content) << name;
    EXPECT_EQ(document(dir, "sheet.json").at("kept_images"), 30);
    EXPECT_GT(document(dir, "sheet.json").at("total_seconds").get<double>(), 0.0);
    const json images = document(whole, "sheet.json").at("images");
    for (const json &image : images) { // as in the record, but for the errors
        const std::string id = image.at("id");
        json record = test::without_times(document(dir, id + ".json").at("image"));
        for (const char *error : {"relrmse", "max_error", "bias"})
            if (image.contains(error)) record[error] = image.at(error);
        EXPECT_EQ(record, test::without_times(image)) << id;
    }
}

TEST(CliSheetImages, TheSameAgainIsTheSame) {
    const test::TempDir dir;
    const Arguments call = only(dir.path(), "1.1.2,1.1.1,1.1.3");
    ASSERT_CLI_OK(test::cli(call));
    EXPECT_EQ(dir.names(),
              (Arguments{"1.1.1.exr", "1.1.1.json", "1.1.2.exr", "1.1.2.json", "1.1.3.exr", "1.1.3.json"}));
    ASSERT_CLI_OK(test::cli(test::with(call, {"--collect"})));
    const auto first = bytes_of(dir);
    ASSERT_CLI_OK(test::cli(call));
    for (const auto &[name, bytes] : bytes_of(dir))
        if (!name.starts_with("1") || name.ends_with(".exr")) {
            EXPECT_TRUE(first.at(name) == bytes) << name; // sheet.json too: it is about the same images
        }

    // With --resume, only what is not there.
    const auto before = bytes_of(dir);
    test::write_file(dir / "1.1.2.exr", "another");
    fs::remove(dir / "1.1.3.json");
    const auto kept = fs::last_write_time(dir / "1.1.1.exr");
    const test::CliResult resumed = test::cli(test::with(call, {"--resume", "--json"}));
    ASSERT_CLI_OK(resumed);
    ASSERT_EQ(resumed.json().size(), 3u);
    EXPECT_EQ(resumed.json()[1].at("id"), "1.1.2");
    EXPECT_EQ(fs::last_write_time(dir / "1.1.1.exr"), kept);
    for (const char *image : {"1.1.2.exr", "1.1.3.exr"}) EXPECT_TRUE(test::read_file(dir / image) == before.at(image));
}

TEST(CliSheetImages, AnotherImageTakesTheSheetAway) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(only(dir.path(), "1.1.1,1.1.2")));
    ASSERT_CLI_OK(test::cli(only(dir.path(), "1.1.1,1.1.2", {"--collect"})));
    EXPECT_EQ(document(dir, "sheet.json").at("only"), json::parse(R"(["1.1.1", "1.1.2"])"));
    ASSERT_CLI_OK(test::cli(test::replaced(only(dir.path(), "1.1.2"), "--spp", "256")));
    EXPECT_FALSE(test::exists(dir / "sheet.json") || test::exists(dir / "sheet.png"));
}

TEST(CliSheetImages, WhatCannotBeCollectedIsNamed) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(1, "1.1.1.json: it is not there; render it with --only 1.1.1", sheet(dir.path(), {"--collect"}));
    ASSERT_CLI_OK(test::cli(only(dir.path(), "1.1.2,1.1.3,1.1.5")));
    const Arguments collect = only(dir.path(), "1.1.2,1.1.3", {"--collect"});
    ASSERT_CLI_OK(test::cli(collect));
    const auto before = bytes_of(dir);

    EXPECT_CLI_FAILS(1, "1.1.4.json: it is not there", only(dir.path(), "1.1.5", {"--collect"})); // its reference
    EXPECT_CLI_FAILS(1, "1.1.2.json: it was made with spp = 64, and this run has 256",
                     test::replaced(collect, "--spp", "256"));
    EXPECT_CLI_FAILS(1, "made with sha256", test::replaced(collect, "sheet", "builtin:two-layer"));
    test::write_file(dir / "1.1.2.exr", test::read_file(dir / "1.1.3.exr"));
    EXPECT_CLI_FAILS(1, "1.1.2.exr is not the image that it describes", collect);
    test::write_file(dir / "1.1.2.exr", before.at("1.1.2.exr"));
    json record = document(dir, "1.1.3.json");
    record["fit"]["model"] = "neither";
    for (const std::string &bad : {before.at("1.1.3.json").substr(0, 200), std::string(), record.dump()}) {
        test::write_file(dir / "1.1.3.json", bad);
        EXPECT_CLI_FAILS(1, "1.1.3.json: it is damaged", collect);
    }
    test::write_file(dir / "1.1.3.json", before.at("1.1.3.json"));
    EXPECT_TRUE(bytes_of(dir) == before);
    EXPECT_CLI_FAILS(2, "--resume", test::with(collect, {"--resume"}));
}

TEST(CliSheetImages, FromMaterialFiles) {
    const test::TempDir dir, from_files, other;
    const Arguments flags = fits(dir, "builtin:conductor");
    ASSERT_CLI_OK(test::cli(sheet(dir.path())));
    ASSERT_CLI_OK(test::cli(sheet(from_files.path(), flags)));
    ASSERT_CLI_OK(test::cli(only(other.path(), "1.1.2,1.1.3,1.1.8", flags)));
    for (const std::string image : {"1.1.3.exr", "1.1.8.exr"}) { // shared, per-lobe
        EXPECT_TRUE(test::read_file(from_files / image) == test::read_file(dir / image)) << image;
        EXPECT_TRUE(test::read_file(other / image) == test::read_file(dir / image)) << image;
    }
    EXPECT_TRUE(document(other, "1.1.3.json").at("fit").at("material_sha256").is_string());

    // Images of two fits are no sheet, and a sheet does not go on with another fit.
    ASSERT_CLI_OK(test::cli(only(other.path(), "1.1.4,1.1.5")));
    EXPECT_CLI_FAILS(1, "1.1.5.exr is of another fit", only(other.path(), "1.1.2,1.1.3,1.1.4,1.1.5", {"--collect"}));
    const Arguments longer = test::replaced(sheet(from_files.path()), "--spp", "16384");
    test::CliSetting killed;
    killed.signal = SIGKILL;
    killed.signal_when = [&] { return test::exists(from_files / "sheet.partial.json"); };
    ASSERT_EQ(test::cli(test::with(longer, flags), killed).status, -1);
    EXPECT_CLI_FAILS(1, "made with material_files", test::with(longer, {"--resume"}));
}

TEST(CliSheetImages, OtherMaterialFilesAreRefused) {
    const test::TempDir dir;
    const Arguments flags = fits(dir, "builtin:two-layer"), others = fits(dir, "builtin:conductor");
    const std::string out = dir / "sheet";
    const auto two_layer = [&](const Arguments &more, const char *lobes = "2") {
        return test::replaced(test::replaced(only(out, "1.1.3", more), "sheet", "builtin:two-layer"), "--lobes", lobes);
    };
    EXPECT_CLI_FAILS(2, "this sheet has 2 fits", two_layer({flags[0], flags[1]}));
    EXPECT_CLI_FAILS(1, "conductor.json is no fit of this table", two_layer(others));
    EXPECT_CLI_FAILS(1, "is a per-lobe material of 2 lobes", two_layer({flags[2], flags[3], flags[0], flags[1]}));
    EXPECT_CLI_FAILS(1, "is a shared material of 2 lobes", two_layer(flags, "1"));
    EXPECT_CLI_FAILS(1, "no-such.json", two_layer({"--fit", dir / "no-such.json", "--fit", flags[3]}));
    EXPECT_CLI_FAILS(2, "--fit", sheet(out, test::with(flags, {"--collect"})));
    EXPECT_FALSE(test::exists(out + "/1.1.3.exr"));
}
