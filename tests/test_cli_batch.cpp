// slopemix fit over many materials: what is fitted, what is left alone, what is in fits.csv and fits.json, what a bad
// file and an interruption leave behind.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "cli.h"
#include "files.h"
#include "fit_batch.h"
#include "support.h"

using nlohmann::json;
using test::fit_of;
using test::make_tables;
using test::names_in;
using test::rows_in;
namespace fs = std::filesystem;

namespace {

using Arguments = std::vector<std::string>;

// Records and fields as RFC 4180 has them.
std::vector<Arguments> parse_csv(const std::string &text) {
    std::vector<Arguments> records;
    bool quoted = false, fresh = true;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (fresh) records.push_back({""});
        fresh = false;
        std::string &field = records.back().back();
        if (quoted && text[k] == '"' && k + 1 < text.size() && text[k + 1] == '"')
            field += text[k++];
        else if (text[k] == '"')
            quoted = !quoted;
        else if (!quoted && text[k] == ',')
            records.back().emplace_back();
        else if (!quoted && text[k] == '\n')
            fresh = true;
        else
            field += text[k];
    }
    return records;
}

// The text says the same as the value.
void expect_same(const std::string &text, const json &value, const std::string &where) {
    if (value.is_null())
        EXPECT_EQ(text, "") << where;
    else if (value.is_string())
        EXPECT_EQ(text, value) << where;
    else if (value.is_number())
        EXPECT_EQ(std::stod(text), value.get<double>()) << where;
    else {
        std::stringstream list(text);
        std::string element;
        std::size_t count = 0;
        for (; std::getline(list, element, ';'); ++count) expect_same(element, value.at(count), where);
        EXPECT_EQ(count, value.size()) << where;
    }
}

} // namespace

TEST(CliBatch, GoesOnAfterABadFile) {
    const test::TempDir dir;
    Arguments tables = make_tables(dir, {"c", "a"});
    test::write_file(dir / "b.binary", "too short");
    tables.insert(tables.begin() + 1, dir / "b.binary");
    const test::CliResult run = test::cli(fit_of(dir, tables, {"--jobs", "2"}));
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("b.binary"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("1 of 3 inputs failed"), std::string::npos) << run.err;
    EXPECT_EQ(names_in(rows_in(dir)), (Arguments{"a", "c"}));
    EXPECT_EQ(parse_csv(test::read_file(dir / "out/fits.csv")).size(), 3u);
    EXPECT_TRUE(test::exists(dir / "out/a.json") && test::exists(dir / "out/c.json"));
    EXPECT_LT(run.out.find(" c  shared"), run.out.find(" a  shared")) << run.out; // as the inputs stand
}

TEST(CliBatch, LeavesAloneWhatIsUpToDate) {
    const test::TempDir dir;
    const Arguments tables = make_tables(dir, {"a", "b"});
    const auto states = [&](const Arguments &more) {
        const test::CliResult run = test::cli(fit_of(dir, tables, test::with({"--json"}, more)));
        EXPECT_EQ(run.status, 0) << run.err;
        std::vector<bool> fresh;
        const json materials = run.json().at("materials");
        for (const json &material : materials) fresh.push_back(!material.at("up_to_date"));
        return fresh;
    };
    using States = std::vector<bool>;
    EXPECT_EQ(states({}), (States{true, true}));
    const auto time = fs::last_write_time(dir / "out/a.json");
    const std::string csv = test::read_file(dir / "out/fits.csv");
    EXPECT_EQ(states({}), (States{false, false}));
    EXPECT_EQ(fs::last_write_time(dir / "out/a.json"), time);
    EXPECT_EQ(test::read_file(dir / "out/fits.csv"), csv);

    EXPECT_EQ(states({"--refit"}), (States{true, true}));
    EXPECT_GT(fs::last_write_time(dir / "out/a.json"), time);
    EXPECT_EQ(states({"--lobes", "3"}), (States{true, true})); // other options
    EXPECT_EQ(states({}), (States{true, true}));
    fs::remove(dir / "out/a.json");
    EXPECT_EQ(states({}), (States{true, false}));
    test::write_file(dir / "out/b.json", "damaged");
    EXPECT_EQ(states({}), (States{false, true}));
    fs::remove(tables[0]);
    EXPECT_EQ(test::cli({"synth", "builtin:two-layer", "--out", tables[0]}).status, 0);
    EXPECT_EQ(states({}), (States{true, false})); // another table

    std::string text = test::read_file(dir / "out/fits.json");
    const std::string version = std::string("\"version\": \"") + smx_version();
    text.replace(text.find(version), version.size(), "\"version\": \"0.0.0");
    test::write_file(dir / "out/fits.json", text);
    EXPECT_EQ(states({}), (States{true, false})); // another version of the library
    fs::remove(dir / "out/fits.csv");
    EXPECT_EQ(states({}), (States{false, false}));
    EXPECT_TRUE(test::exists(dir / "out/fits.csv"));
}

TEST(CliBatch, ResumesAfterAnInterruption) {
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        SCOPED_TRACE(signal);
        const test::TempDir dir;
        const Arguments names = {"a", "b", "c", "d", "e", "f"}, tables = make_tables(dir, names);
        const auto material = [&](const std::string &name) { return dir / ("out/" + name + ".json"); };
        test::CliSetting setting;
        setting.signal = signal;
        setting.signal_when = [&] { return test::exists(dir / "out/fits.json") && test::exists(material("b")); };
        const test::CliResult first = test::cli(fit_of(dir, tables, {"--jobs", "1"}), setting);
        EXPECT_EQ(first.status, signal == SIGKILL ? -1 : 1);
        const Arguments done = names_in(rows_in(dir));
        ASSERT_GE(done.size(), 1u);
        ASSERT_LT(done.size(), names.size());
        if (signal != SIGKILL) {
            EXPECT_NE(first.err.find("cancelled"), std::string::npos) << first.err;
            for (const std::string &name : names)
                EXPECT_EQ(test::exists(material(name)), std::count(done.begin(), done.end(), name) == 1) << name;
        }
        const auto time = fs::last_write_time(material("a"));
        const test::CliResult second = test::cli(fit_of(dir, tables, {"--resume", "--json"}));
        ASSERT_CLI_OK(second);
        EXPECT_EQ(fs::last_write_time(material("a")), time);
        const json materials = second.json().at("materials");
        for (const json &fitted : materials) {
            const std::string name = fitted.at("name");
            EXPECT_EQ(fitted.at("up_to_date"), std::count(done.begin(), done.end(), name) == 1) << name;
        }
        EXPECT_EQ(names_in(rows_in(dir)), names);
        EXPECT_EQ(parse_csv(test::read_file(dir / "out/fits.csv")).size(), names.size() + 1);
    }
}

// What it leaves alone is what fit leaves alone; it only says so.
TEST(CliBatch, ResumeFitsWhatIsOfOtherOptions) {
    const test::TempDir dir;
    const Arguments tables = make_tables(dir, {"a"});
    const auto up_to_date = [&](const Arguments &more) {
        const test::CliResult run = test::cli(fit_of(dir, tables, test::with({"--resume", "--json"}, more)));
        EXPECT_EQ(run.status, 0) << run.err;
        return run.json().at("materials").at(0).at("up_to_date").get<bool>();
    };
    EXPECT_FALSE(up_to_date({}));
    EXPECT_TRUE(up_to_date({}));
    EXPECT_FALSE(up_to_date({"--lobes", "3"}));
    EXPECT_CLI_FAILS(2, "--refit", fit_of(dir, tables, {"--resume", "--refit"}));
    EXPECT_CLI_FAILS(2, "--resume", {"fit", tables[0], "--compare", tables[0], "--resume"});
}

TEST(CliBatch, CsvAndJsonSayTheSame) {
    const test::TempDir dir;
    const Arguments tables = make_tables(dir, {"od\"d, name", "plain"}, "builtin:two-layer");
    ASSERT_CLI_OK(test::cli(fit_of(dir, {tables[0]})));
    ASSERT_CLI_OK(test::cli({"fit", "--out", dir / "out", "--lobes", "3", tables[1]})); // per-lobe
    const json rows = rows_in(dir);
    const std::vector<Arguments> csv = parse_csv(test::read_file(dir / "out/fits.csv"));
    ASSERT_EQ(rows.size(), 2u); // the first run's is kept
    ASSERT_EQ(csv.size(), 3u);
    EXPECT_EQ(rows[0].at("name"), "od\"d, name");
    for (std::size_t k = 0; k < rows.size(); ++k) {
        ASSERT_EQ(csv[k + 1].size(), csv[0].size());
        ASSERT_EQ(rows[k].size(), csv[0].size());
        for (std::size_t c = 0; c < csv[0].size(); ++c) expect_same(csv[k + 1][c], rows[k].at(csv[0][c]), csv[0][c]);

        // And the same as the material.
        test::Material material;
        const std::string file = dir / ("out/" + rows[k].at("name").get<std::string>() + ".json");
        ASSERT_SMX_OK(smx_material_load(file.c_str(), material.out()));
        const std::vector<smx_lobe> lobes = test::lobes_of(material);
        const bool shared = test::info_of(material).model == SMX_MODEL_SHARED;
        EXPECT_EQ(shared, k == 0);
        ASSERT_EQ(rows[k].at("alpha").size(), lobes.size());
        for (std::size_t j = 0; j < lobes.size(); ++j) {
            EXPECT_EQ(rows[k].at("alpha").at(j), lobes[j].alpha);
            EXPECT_EQ(rows[k].at(shared ? "weight" : "energy").at(j), lobes[j].weight);
        }
        EXPECT_TRUE(rows[k].at(shared ? "energy" : "weight").is_null());
        const test::Curves curves = test::curves_of(material);
        const std::size_t knots = curves.theta_d.size();
        double green = 0.0;
        for (std::size_t set = 0; set < (shared ? 1 : lobes.size()); ++set)
            green += curves.fresnel[(3 * set + 1) * knots];
        EXPECT_DOUBLE_EQ(rows[k].at("f0_g"), green);
    }
}

TEST(CliBatch, MetricsAreThoseOfTheLibrary) {
    const test::TempDir dir;
    const Arguments fit = {"fit", "builtin:two-layer", "--lobes", "2", "--json", "--out", dir / "out"};
    const auto material_of = [&](const Arguments &more) {
        const test::CliResult run = test::cli(test::with(fit, more));
        EXPECT_EQ(run.status, 0) << run.err;
        return run.json().at("materials").at(0);
    };
    EXPECT_TRUE(material_of({}).at("metrics").is_null());
    EXPECT_TRUE(rows_in(dir).at(0).at("ggx_lambert_log_80").is_null());
    const auto time = fs::last_write_time(dir / "out/two-layer.json");

    // They are added to a fit that is up to date, and kept.
    const json material = material_of({"--metrics"}), figures = material.at("metrics"), row = rows_in(dir).at(0);
    EXPECT_TRUE(material.at("up_to_date"));
    EXPECT_EQ(material_of({"--metrics"}).at("metrics"), figures);
    EXPECT_EQ(material_of({}).at("metrics"), figures);
    EXPECT_EQ(fs::last_write_time(dir / "out/two-layer.json"), time);
    EXPECT_EQ(figures.size(), 31u);
    for (const auto &[name, value] : figures.items()) {
        EXPECT_EQ(row.at(name), value) << name;
        EXPECT_GT(value.get<double>(), 0.0) << name;
    }

    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:two-layer", brdf.out()));
    const auto expect_figures = [&](const std::string &model, const smx_brdf_errors &errors) {
        EXPECT_EQ(figures.at(model + "_l2"), errors.l2) << model;
        EXPECT_EQ(figures.at(model + "_log"), errors.log) << model;
        EXPECT_EQ(figures.at(model + "_cube_root"), errors.cube_root) << model;
        EXPECT_EQ(figures.at(model + "_l2_80"), errors.l2_80) << model;
        EXPECT_EQ(figures.at(model + "_log_80"), errors.log_80) << model;
        EXPECT_EQ(figures.at(model + "_cube_root_80"), errors.cube_root_80) << model;
    };
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
        const test::Material fitted = test::fit(test::make_density(brdf, SMX_MASKING_COINCIDES), 2, model);
        smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
        ASSERT_SMX_OK(smx_material_brdf_errors(fitted, brdf, &errors));
        expect_figures(model == SMX_MODEL_SHARED ? "shared" : "per_lobe", errors);
    }
    const std::pair<const char *, smx_baseline> baselines[] = {
        {"beckmann", SMX_BASELINE_BECKMANN}, {"ggx", SMX_BASELINE_GGX}, {"ggx_lambert", SMX_BASELINE_GGX_LAMBERT}};
    for (const auto &[name, kind] : baselines) {
        smx_baseline_report report = SMX_BASELINE_REPORT_INIT;
        ASSERT_SMX_OK(smx_baseline_fit(brdf, kind, &report));
        expect_figures(name, report.errors);
    }

    EXPECT_FALSE(material_of({"--refit"}).at("up_to_date"));
    EXPECT_TRUE(rows_in(dir).at(0).at("shared_l2").is_null()); // another fit's would be out of date
}

TEST(CliBatch, ThreadsChangeNothing) {
    const test::TempDir dir;
    const Arguments tables = make_tables(dir, {"a", "b", "c"});
    const auto rows = [&](const char *jobs) {
        EXPECT_EQ(test::cli(fit_of(dir, tables, {"--refit", "--jobs", jobs})).status, 0);
        json all = rows_in(dir);
        for (json &row : all) {
            row.erase("seconds");
            row.erase("check_seconds");
        }
        return all;
    };
    EXPECT_EQ(rows("1"), rows("3"));
    EXPECT_CLI_FAILS(2, "--jobs", fit_of(dir, tables, {"--jobs", "0"}));
    EXPECT_CLI_FAILS(2, "--jobs", fit_of(dir, tables, {"--jobs", "257"}));
}

TEST(CliBatch, ADamagedTableIsNotOverwritten) {
    const test::TempDir dir;
    fs::create_directory(dir / "out");
    const std::string head = R"({"format": "slopemix-fits", "version": 1, "materials": )";
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"{", "no JSON"},
        {"[]", "format"},
        {R"({"format": "slopemix-fits", "version": 2, "materials": []})", "version is 2"},
        {R"({"format": "slopemix-fits", "version": 1})", "list of materials"},
        {head + "[7]}", "materials[0] is no object"},
        {head + R"([{"name": "x"}, {"input": "y"}]})", "materials[1] has no name"},
        {head + R"([{"name": "x"}, {"name": "x"}]})", "name of another"},
        {head + R"([{"name": "x", "alpha": {}}]})", "\"alpha\""}};
    for (const auto &[text, needle] : bad) {
        test::write_file(dir / "out/fits.json", text);
        EXPECT_CLI_FAILS(1, needle, fit_of(dir, {"builtin:conductor"}));
        EXPECT_EQ(test::read_file(dir / "out/fits.json"), text);
        EXPECT_FALSE(test::exists(dir / "out/conductor.json"));
    }
    EXPECT_CLI_FAILS(2, "fits.json", fit_of(dir, {"x/fits.binary"}));
}
