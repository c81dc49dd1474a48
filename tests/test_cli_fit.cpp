// slopemix synth and fit: tables and material files, what is reported, and what is left after a failure. Many at a
// time: test_cli_batch.cpp.
#include <gtest/gtest.h>

#include "cli.h"
#include "files.h"
#include "merl_writer.h"
#include "support.h"

using nlohmann::json;

namespace {

// A whole file of the right length whose cells are all invalid.
std::string invalid_table() { return test::merl_bytes({90, 90, 180}, std::vector<double>(3 * 90 * 90 * 180, -1.0)); }

} // namespace

TEST(CliFit, SynthWritesTheBuiltin) {
    const test::TempDir dir;
    for (const char *name : {"two-layer", "conductor"}) {
        const std::string builtin = std::string("builtin:") + name, path = dir / (std::string(name) + ".binary");
        ASSERT_CLI_OK(test::cli({"synth", builtin, "--out", path}));
        EXPECT_EQ(std::filesystem::file_size(path), 34992012u);
        test::Brdf from_file, direct;
        ASSERT_SMX_OK(smx_brdf_open(path.c_str(), from_file.out()));
        ASSERT_SMX_OK(smx_brdf_open(builtin.c_str(), direct.out()));
        const oracle::Table a = test::filled_table(from_file), b = test::filled_table(direct);
        for (std::size_t k = 0; k < a.values.size(); ++k)
            ASSERT_NEAR(a.values[k], b.values[k], 1e-14 * b.values[k]) << name << ", value " << k;
    }
    EXPECT_EQ(dir.names(), (std::vector<std::string>{"conductor.binary", "two-layer.binary"}));
}

TEST(CliFit, WritesAMaterialPerInput) {
    const test::TempDir dir;
    const std::string table = dir / "copy.binary", out = dir / "materials/new";
    ASSERT_CLI_OK(test::cli({"synth", "builtin:conductor", "--out", table}));
    const test::CliResult run = test::cli({"fit", "builtin:two-layer", table, "--out", out, "--lobes", "3"});
    ASSERT_CLI_OK(run);
    for (const char *name : {"two-layer", "copy"}) {
        test::Material material;
        ASSERT_SMX_OK(smx_material_load((out + "/" + name + ".json").c_str(), material.out()));
        EXPECT_LE(test::info_of(material).lobes, 3u);
        EXPECT_STREQ(test::info_of(material).name, name);
        EXPECT_NE(run.out.find(name), std::string::npos) << run.out;
    }
}

TEST(CliFit, JsonSaysHowItWent) {
    const test::TempDir dir;
    for (const char *model : {"shared", "per-lobe"}) {
        const test::CliResult run =
            test::cli({"fit", "builtin:two-layer", "--out", dir.path(), "--lobes", "4", "--model", model, "--json"});
        ASSERT_CLI_OK(run);
        const json fit = run.json().at("materials").at(0);
        EXPECT_EQ(fit.at("input"), "builtin:two-layer");
        EXPECT_EQ(fit.at("file"), dir / "two-layer.json");
        EXPECT_GE(fit.at("lobes").size(), 1u);
        for (const json &lobe : fit.at("lobes")) {
            EXPECT_GT(lobe.at("weight").get<double>(), 0.0);
            EXPECT_GT(lobe.at("alpha").get<double>(), 0.0);
        }
        EXPECT_TRUE(fit.at("log_likelihood").is_number());
        EXPECT_LT(fit.at("residual").get<double>(), 0.2);
        EXPECT_GT(fit.at("iterations").at("inversion").get<int>(), 0);
        EXPECT_GT(fit.at("seconds").get<double>(), 0.0);
        EXPECT_TRUE(run.json().at("failures").empty());
    }
}

TEST(CliFit, OneBadInputDoesNotStopTheOthers) {
    const test::TempDir dir;
    test::write_file(dir / "short.binary", "too short");
    const test::CliResult run =
        test::cli({"fit", dir / "short.binary", "builtin:conductor", "--out", dir / "out", "--json"});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("short.binary"), std::string::npos) << run.err;
    EXPECT_EQ(run.json().at("materials").size(), 1u);
    EXPECT_EQ(run.json().at("failures").size(), 1u);
    EXPECT_TRUE(test::exists(dir / "out/conductor.json"));
    EXPECT_FALSE(test::exists(dir / "out/short.json"));
}

TEST(CliFit, BadTablesKeepWhatWasThere) {
    const test::TempDir dir;
    std::string nan_table = invalid_table();
    const double nan = std::nan("");
    std::memcpy(nan_table.data() + 12, &nan, 8);
    const std::vector<std::pair<std::string, std::string>> bad{{"", "0"},
                                                               {std::string(100, 'x'), "dimensions"},
                                                               {invalid_table(), "valid"},
                                                               {nan_table, "nan"},
                                                               {invalid_table() + "x", "34992013"}};
    test::write_file(dir / "t.json", "precious");
    for (const auto &[bytes, needle] : bad) {
        test::write_file(dir / "t.binary", bytes);
        EXPECT_CLI_FAILS(1, needle, {"fit", dir / "t.binary", "--out", dir.path()});
        EXPECT_EQ(test::read_file(dir / "t.json"), "precious");
        EXPECT_EQ(dir.names(), (std::vector<std::string>{"t.binary", "t.json"}));
    }
}

TEST(CliFit, EqualNamesAreRefused) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(2, "x.json", {"fit", "a/x.binary", "b/x.binary", "--out", dir.path()});
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliFit, UnwritableOutputsFailWithoutATrace) {
    const test::TempDir dir;
    test::write_file(dir / "file", "precious");
    test::write_file(dir / "conductor.json", "precious");
    EXPECT_CLI_FAILS(1, "file", {"fit", "builtin:conductor", "--out", dir / "file"});
    EXPECT_CLI_FAILS(1, "file", {"synth", "builtin:conductor", "--out", dir / "file/x.binary"});
    EXPECT_CLI_FAILS(1, "conductor.json", {"fit", "builtin:conductor", "--out", dir.path()}, {{}, 512});
    EXPECT_CLI_FAILS(1, "conductor.json", {"synth", "builtin:conductor", "--out", dir / "conductor.json"},
                     {{}, 1 << 20});
    EXPECT_EQ(test::read_file(dir / "file"), "precious");
    EXPECT_EQ(test::read_file(dir / "conductor.json"), "precious");
    EXPECT_EQ(dir.names(), (std::vector<std::string>{"conductor.json", "file"}));
}
