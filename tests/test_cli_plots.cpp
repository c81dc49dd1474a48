// slopemix fit --plot: pictures of fits that are SVG, drawn where they are missing or old, and a gnuplot that fails.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "cli.h"
#include "files.h"
#include "fit_batch.h"

namespace fs = std::filesystem;
using test::fit_of;
using test::make_tables;
using test::names_in;
using test::rows_in;

namespace {

using Arguments = std::vector<std::string>;

// Every element that is opened is closed, in order; an error's place otherwise.
std::string xml_fault(const std::string &text) {
    if (!text.starts_with("<?xml")) return "no declaration";
    Arguments open;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
        if (text.compare(at, 4, "<!--") == 0 || text.compare(at, 9, "<![CDATA[") == 0) continue;
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return "open tag at " + std::to_string(at);
        if (text[at + 1] == '?' || text[at + 1] == '!' || text[end - 1] == '/') continue;
        const bool closes = text[at + 1] == '/';
        const std::size_t begin = at + (closes ? 2 : 1);
        const std::string name = text.substr(begin, text.find_first_of(" \t\n>", begin) - begin);
        if (!closes)
            open.push_back(name);
        else if (open.empty() || open.back() != name)
            return "stray </" + name + "> at " + std::to_string(at);
        else
            open.pop_back();
    }
    return open.empty() ? "" : "<" + open.back() + "> stays open";
}

void make_program(const std::string &path, const std::string &script) {
    test::write_file(path, script);
    fs::permissions(path, fs::perms::owner_all);
}

} // namespace

TEST(CliPlots, PlotsAreSvg) {
    const test::TempDir dir;
    const std::string odd = "it's {a_b} & <c>";
    const Arguments tables = make_tables(dir, {odd}, "builtin:two-layer");
    for (const char *lobes : {"1", "16"}) {
        ASSERT_CLI_OK(test::cli(fit_of(dir, tables, {"--plot", "--lobes", lobes})));
        const std::string svg = test::read_file(dir / ("out/" + odd + ".svg"));
        EXPECT_EQ(xml_fault(svg), "");
        for (const char *text :
             {"it's {a_b} &amp; &lt;c>", "Slope density", "Fresnel curves, blue", "BRDF slice", "measured", "per-lobe"})
            EXPECT_NE(svg.find(text), std::string::npos) << text;
    }
    EXPECT_NE(xml_fault("<?xml?><a><b></a>"), "");
}

TEST(CliPlots, PlotsAreDrawnWhereTheyAreMissingOrOld) {
    const test::TempDir dir;
    const Arguments tables = make_tables(dir, {"a"});
    const std::string svg = dir / "out/a.svg", material = dir / "out/a.json";
    ASSERT_CLI_OK(test::cli(fit_of(dir, tables)));
    const auto fitted = fs::last_write_time(material);
    ASSERT_CLI_OK(test::cli(fit_of(dir, tables, {"--plot"})));
    EXPECT_EQ(fs::last_write_time(material), fitted);
    const auto drawn = fs::last_write_time(svg);
    ASSERT_CLI_OK(test::cli(fit_of(dir, tables, {"--plot"})));
    EXPECT_EQ(fs::last_write_time(svg), drawn);
    fs::last_write_time(svg, fitted - std::chrono::hours(1));
    ASSERT_CLI_OK(test::cli(fit_of(dir, tables, {"--plot"})));
    EXPECT_GE(fs::last_write_time(svg), fitted);
}

TEST(CliPlots, WithoutGnuplotNothingBegins) {
    const test::TempDir dir;
    EXPECT_CLI_FAILS(1, "gnuplot-nox", fit_of(dir, {"builtin:conductor"}, {"--plot"}), {{{"PATH", ""}}});
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliPlots, AFailedPlotLosesNoFit) {
    const test::TempDir dir;
    fs::create_directory(dir / "bin");
    make_program(dir / "bin/gnuplot", "#!/bin/sh\ntest \"$2\" = --version && exit 0\necho no pen >&2\nexit 3\n");
    const std::string path = (dir / "bin") + ":/usr/bin:/bin";
    EXPECT_CLI_FAILS(1, "status 3: no pen", fit_of(dir, {"builtin:conductor"}, {"--plot"}), {{{"PATH", path}}});
    EXPECT_EQ(names_in(rows_in(dir)), Arguments{"conductor"});
    EXPECT_FALSE(test::exists(dir / "out/conductor.svg"));
    const test::CliResult run = test::cli(fit_of(dir, {"builtin:conductor"}, {"--plot", "--json"}));
    ASSERT_CLI_OK(run);
    EXPECT_TRUE(run.json().at("materials").at(0).at("up_to_date"));
    EXPECT_TRUE(run.json().at("build_seconds").is_number());
    EXPECT_TRUE(test::exists(dir / "out/conductor.svg"));
    const test::CliResult without = test::cli(fit_of(dir, {"builtin:conductor"}, {"--json"}));
    ASSERT_CLI_OK(without);
    EXPECT_TRUE(without.json().at("build_seconds").is_null());
}
