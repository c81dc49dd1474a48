// Inputs other than files of tables, and tables compared in BRDF space.
#include <gtest/gtest.h>

#include "cli.h"
#include "close.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

const std::string ggx = "analytic:ggx,alpha=0.2,f0=0.9/0.6/0.5";
const std::string density_rows = "theta,ndf\n0,3.5\n0.2,1.6\n0.5,0.1\n1.5,0\n";

} // namespace

TEST(CliInputs, AnalyticMaterialsStandForTables) {
    const test::TempDir dir;
    const std::string table = dir / "ggx.binary";
    ASSERT_CLI_OK(test::cli({"synth", ggx, "--out", table}));
    ASSERT_CLI_OK(test::cli({"fit", ggx, "--out", dir / "fits", "--lobes", "2"}));
    test::Material material;
    ASSERT_SMX_OK(smx_material_load((dir / "fits/ggx,alpha=0.2,f0=0.9_0.6_0.5.json").c_str(), material.out()));
    EXPECT_EQ(test::info_of(material).source, ggx);
    const test::CliResult same = test::cli({"fit", ggx, "--compare", table, "--json"});
    ASSERT_CLI_OK(same);
    EXPECT_LT(same.json().at("l2").get<double>(), 1e-12);
}

TEST(CliInputs, WrongAnalyticMaterialsFail) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(1, "0.001..10", {"fit", "analytic:ggx,alpha=0,f0=1", "--out", dir.path()});
    EXPECT_CLI_FAILS(1, "f0 is missing", {"synth", "analytic:ggx,alpha=1", "--out", dir / "x.binary"});
    EXPECT_CLI_FAILS(2, "analytic:KIND", {"synth", "x.binary", "--out", dir / "x.binary"});
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliInputs, DensitiesTakeTheSharedModel) {
    const test::TempDir dir;
    test::write_file(dir / "paint.csv", density_rows);
    const std::string input = "density:" + (dir / "paint.csv");
    const test::CliResult plain = test::cli({"fit", input, "--out", dir / "out", "--json"});
    ASSERT_CLI_OK(plain);
    const json fit = plain.json().at("materials").at(0);
    EXPECT_EQ(fit.at("model"), "shared");
    EXPECT_NE(fit.at("model_note").get<std::string>().find("no BRDF"), std::string::npos);
    test::Material material;
    ASSERT_SMX_OK(smx_material_load((dir / "out/paint.json").c_str(), material.out()));
    EXPECT_EQ(test::info_of(material).model, SMX_MODEL_SHARED);
    EXPECT_EQ(test::info_of(material).source, dir / "paint.csv");

    const test::CliResult text = test::cli({"fit", input, "--out", dir / "out", "--model", "shared"});
    ASSERT_CLI_OK(text);
    EXPECT_NE(text.out.find("no BRDF"), std::string::npos) << text.out;
    // A table beside it keeps the default model, and has no note.
    const test::CliResult both = test::cli({"fit", input, "builtin:conductor", "--out", dir / "out", "--json"});
    ASSERT_CLI_OK(both);
    EXPECT_EQ(both.json().at("materials").at(1).at("model"), "per-lobe");
    EXPECT_TRUE(both.json().at("materials").at(1).at("model_note").is_null());
}

TEST(CliInputs, DensitiesAreUpToDateByTheirFile) {
    const test::TempDir dir;
    const std::string file = dir / "paint.csv", svg = dir / "out/paint.svg";
    const auto is_up_to_date = [&](const std::vector<std::string> &more) {
        const test::CliResult run =
            test::cli(test::with({"fit", "density:" + file, "--out", dir / "out", "--lobes", "2", "--json"}, more));
        EXPECT_EQ(run.status, 0) << run.err;
        return run.json().at("materials").at(0).at("up_to_date").get<bool>();
    };
    test::write_file(file, density_rows);
    EXPECT_FALSE(is_up_to_date({}));
    EXPECT_TRUE(is_up_to_date({"--model", "shared"}));
    const json row = json::parse(test::read_file(dir / "out/fits.json")).at("materials").at(0);
    EXPECT_EQ(row.at("options"), "--model shared --lobes 2");
    EXPECT_TRUE(is_up_to_date({"--plot", "--metrics"})); // without a BRDF there are no figures to miss
    const std::string picture = test::read_file(svg);
    EXPECT_NE(picture.find("Slope density"), std::string::npos);
    EXPECT_EQ(picture.find("Fresnel"), std::string::npos);
    EXPECT_EQ(picture.find("slice"), std::string::npos);
    test::write_file(file, density_rows + std::string("1.55,0\n"));
    EXPECT_FALSE(is_up_to_date({}));
}

TEST(CliInputs, DensitiesAreRefusedWhereABrdfIsNeeded) {
    const test::TempDir dir;
    test::write_file(dir / "paint.csv", density_rows);
    const std::string input = "density:" + (dir / "paint.csv");
    EXPECT_CLI_FAILS(2, "--model", {"fit", "builtin:conductor", input, "--model", "per-lobe", "--out", dir / "out"});
    EXPECT_CLI_FAILS(1, "slope density", {"fit", "builtin:conductor", "--compare", input});
    EXPECT_CLI_FAILS(1, "slope density", {"sheet", input, "--out", dir / "sheet"});
    EXPECT_CLI_FAILS(1, "line 2", [&] {
        test::write_file(dir / "bad.csv", "theta,p22\n0,x\n");
        return std::vector<std::string>{"fit", "density:" + (dir / "bad.csv"), "--out", dir / "out"};
    }());
    EXPECT_FALSE(test::exists(dir / "out/paint.json"));
    EXPECT_FALSE(test::exists(dir / "out/conductor.json"));
}

TEST(CliCompareTables, PrintsTheFiguresOfTheOtherAgainstItsSource) {
    const std::string source = "analytic:lambert,albedo=0.5", other = "analytic:lambert,albedo=0.6";
    const test::CliResult run = test::cli({"fit", source, "--compare", other, "--json"});
    ASSERT_CLI_OK(run);
    test::Brdf a, b;
    ASSERT_SMX_OK(smx_brdf_open(source.c_str(), a.out()));
    ASSERT_SMX_OK(smx_brdf_open(other.c_str(), b.out()));
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    ASSERT_SMX_OK(smx_brdf_compare(b, a, &errors));
    const json document = run.json();
    EXPECT_EQ(document.at("input"), source);
    EXPECT_EQ(document.at("compare"), other);
    EXPECT_EQ(document.at("l2").get<double>(), errors.l2);
    EXPECT_EQ(document.at("log").get<double>(), errors.log);
    EXPECT_EQ(document.at("cube_root").get<double>(), errors.cube_root);
    EXPECT_EQ(document.at("l2_80").get<double>(), errors.l2_80);
    EXPECT_EQ(document.at("log_80").get<double>(), errors.log_80);
    EXPECT_EQ(document.at("cube_root_80").get<double>(), errors.cube_root_80);
    const test::CliResult text = test::cli({"fit", source, "--compare", other});
    ASSERT_CLI_OK(text);
    EXPECT_NE(text.out.find("ln(1 + f cos_i)"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("0.018"), std::string::npos) << text.out;
}

TEST(CliCompareTables, WrongUsageIsRefused) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(2, "--compare", {"fit", ggx, "--compare", ggx, "--out", dir.path()});
    EXPECT_CLI_FAILS(2, "one INPUT", {"fit", ggx, "builtin:conductor", "--compare", ggx});
    EXPECT_CLI_FAILS(2, "--out", {"fit", ggx});
    const std::vector<std::vector<std::string>> of_a_fit = {{"--lobes", "2"}, {"--model", "shared"}, {"--jobs", "1"},
                                                            {"--refit"},      {"--metrics"},         {"--plot"}};
    for (const std::vector<std::string> &flag : of_a_fit)
        EXPECT_CLI_FAILS(2, flag[0] + " excludes --compare", test::with({"fit", ggx, "--compare", ggx}, flag));
    EXPECT_CLI_FAILS(1, "no-such.binary", {"fit", ggx, "--compare", "no-such.binary"});
    EXPECT_TRUE(dir.names().empty());
}
