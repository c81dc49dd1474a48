// What every command has in common: help, exit statuses, and bad values refused before anything is done.
#include <gtest/gtest.h>

#include "cli.h"
#include "files.h"
#include "slopemix.h"

namespace {

using Arguments = std::vector<std::string>;

const char *const commands[] = {"info",  "materials", "synth",    "fit",     "render",
                                "sheet", "budget",    "tradeoff", "compare", "bench"};

Arguments render(const std::string &out) {
    return {"render",       "builtin:conductor",
            "--integrator", "reference",
            "--alpha",      "0.1,0.1",
            "--rho",        "0",
            "--light",      "90",
            "--res",        "8",
            "--spp",        "16",
            "--mean-slope", "0,0",
            "--sampler",    "grid",
            "--seed",       "0",
            "--g",          "correlated",
            "--lookup",     "linear",
            "--out",        out};
}

Arguments sheet(const std::string &out) {
    return {"sheet", "builtin:conductor", "--res", "8",      "--spp", "16",    "--radii",
            "0.1",   "--lobes",           "1",     "--only", "1.1.1", "--out", out};
}

} // namespace

TEST(CliUsage, EveryCommandHasHelp) {
    for (const char *command : commands) {
        const test::CliResult result = test::cli({command, "--help"});
        EXPECT_EQ(result.status, 0) << command;
        EXPECT_NE(result.out.find("Usage"), std::string::npos) << result.out;
        EXPECT_EQ(result.err, "");
    }
    const test::CliResult top = test::cli({"--help"});
    EXPECT_EQ(top.status, 0);
    for (const char *command : commands) EXPECT_NE(top.out.find(command), std::string::npos) << command;
}

TEST(CliUsage, VersionIsTheLibrarys) {
    const test::CliResult result = test::cli({"--version"});
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.out.find(SMX_VERSION_STRING), std::string::npos) << result.out;
}

TEST(CliUsage, WrongUsageIsTwo) {
    EXPECT_CLI_FAILS(2, "", Arguments{});
    EXPECT_CLI_FAILS(2, "frobnicate", Arguments{"frobnicate"});
    EXPECT_CLI_FAILS(2, "--frobnicate", Arguments{"info", "--frobnicate"});
    for (const char *command : {"synth", "fit", "render", "sheet", "budget", "tradeoff", "compare"})
        EXPECT_CLI_FAILS(2, "", Arguments{command});
    EXPECT_CLI_FAILS(2, "--out", Arguments{"fit", "builtin:conductor"});
    EXPECT_CLI_FAILS(2, "two-layer.binary", Arguments{"synth", "two-layer.binary", "--out", "x.binary"});
}

TEST(CliUsage, BadValuesAreRefusedByName) {
    const test::TempDir dir;
    const std::vector<std::pair<std::string, Arguments>> bad{
        {"--alpha", {"-0.1,0.1", "0.1,-1e-9", "nan,0.1", "0.1,inf", "0.1", "0.1,0.1,0.1", "a,b", "", "1e5,0"}},
        {"--rho", {"1", "-1", "nan", "2"}},
        {"--mean-slope", {"nan,0", "0,inf", "1", "1e5,0"}},
        {"--light", {"nan", "inf", "east"}},
        {"--res", {"0", "16385", "-8", "8x0", "8x8x8", "8.5"}},
        {"--spp", {"0", "-16", "16777217", "15", "many"}},
        {"--seed", {"-1", "18446744073709551616", "x"}},
        {"--sampler", {"random"}},
        {"--lookup", {"cubic"}},
        {"--g", {"none"}},
        {"--integrator", {"both"}},
        {"--out", {dir / "image.jpg"}},
    };
    for (const auto &[flag, values] : bad)
        for (const std::string &value : values)
            EXPECT_CLI_FAILS(2, flag, test::replaced(render(dir / "x.exr"), flag, value));
    for (const char *lobes : {"0", "65", "-1", "2.5"})
        EXPECT_CLI_FAILS(2, "--lobes", test::with(render(dir / "x.exr"), {"--lobes", lobes}));
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliUsage, BadSheetsAreRefusedByName) {
    const test::TempDir dir;
    const std::vector<std::pair<std::string, Arguments>> bad{
        {"--radii", {"-0.1", "nan", "", "0.1,,0.2"}},
        {"--lobes", {"0", "65", "1,1", "1,x"}},
        {"--only", {"1", "4.1.1", "1.2.1", "1.1.8", "1.1.0", "a.b.c"}},
        {"--spp", {"15"}},
    };
    for (const auto &[flag, values] : bad)
        for (const std::string &value : values)
            EXPECT_CLI_FAILS(2, flag, test::replaced(sheet(dir / "s"), flag, value));
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliUsage, UnknownInputsFail) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(1, "velvet", Arguments{"fit", "builtin:velvet", "--out", dir.path()});
    EXPECT_CLI_FAILS(1, "no-such.binary", Arguments{"fit", "no-such.binary", "--out", dir.path()});
    EXPECT_CLI_FAILS(1, "no-such.exr", Arguments{"compare", dir / "no-such.exr", dir / "no-such.exr"});
    EXPECT_TRUE(dir.names().empty());
}
