// slopemix bench: every row of its list, each with a baseline that was slower, or the closed form, which is faster.
#include <gtest/gtest.h>

#include <set>

#include "cli.h"
#include "close.h"

using nlohmann::json;

namespace {

// One run serves all tests.
const json &rows() {
    static const json list = [] {
        const test::CliResult run = test::cli({"bench", "--quick", "--json"});
        EXPECT_EQ(run.status, 0) << run.err;
        return run.status == 0 ? run.json() : json::array();
    }();
    return list;
}

using Key = std::vector<std::string>; // name, grade, baseline

std::set<Key> expected_rows() {
    std::set<Key> keys;
    for (const std::string grade : {"precise", "fast"}) {
        for (const std::string n : {"n1", "n2", "n4", "n8", "n16"})
            for (const std::string model : {"shared.", "per-lobe."})
                for (const std::string baseline : {"scalar-one-core", "builtin-kernel"})
                    keys.insert({"shade." + model + n, grade, baseline});
        for (const std::string order : {"order1", "order2", "order3", "order5", "order8"})
            keys.insert({"shade.per-lobe.n8." + order, grade, "closed-form"});
        for (const std::string sampling : {"slice.grid", "slice.sobol", "slice.mis", "full.grid", "full.mis"})
            for (const std::string baseline : {"plain-kernel", "scalar-one-core"})
                keys.insert({"reference." + sampling, grade, baseline});
        for (const std::string quantity : {"eval", "pdf", "sample"})
            keys.insert({"evaluator." + quantity + ".per-lobe.n8", grade, "kernel-alone"});
    }
    keys.insert({"evaluator.second-context.n8", "precise", "same-context"});
    keys.insert({"geometric.path", "precise", "statistical"});
    keys.insert({"effects.interreflection", "precise", "geometric.path"});
    for (const std::string n : {".n1", ".n8"})
        for (const std::string left_out :
             {"none", "without-masking", "without-shadowing", "without-height-correlation", "without-fresnel",
              "without-lobe-color", "without-anisotropy", "without-mean-slope"})
            keys.insert({"effects." + left_out + n, "precise", "all-effects"});
    return keys;
}

} // namespace

TEST(CliBench, OneRowPerCaseGradeAndBaseline) {
    std::set<Key> keys;
    for (const json &row : rows()) {
        const Key key{row.at("name").get<std::string>(), row.at("grade").get<std::string>(),
                      row.at("baseline").get<std::string>()};
        EXPECT_TRUE(keys.insert(key).second) << row;
    }
    EXPECT_EQ(keys, expected_rows());
}

TEST(CliBench, TimesAndRatios) {
    const std::set<std::string> columns{"name", "device", "grade", "ns", "baseline", "baseline_ns", "ratio"};
    for (const json &row : rows()) {
        std::set<std::string> names;
        for (const auto &[name, value] : row.items()) names.insert(name);
        EXPECT_EQ(names, columns);
        EXPECT_FALSE(row.at("device").get<std::string>().empty());
        EXPECT_GT(row.at("ns").get<double>(), 0.0) << row;
        EXPECT_CLOSE(row.at("ratio").get<double>(), row.at("baseline_ns").get<double>() / row.at("ns").get<double>(),
                     1e-12, 0.0);
        const std::string name = row.at("name"), baseline = row.at("baseline");
        const double ratio = row.at("ratio");
        if (baseline == "closed-form" || baseline == "statistical" || baseline == "geometric.path") {
            EXPECT_LT(ratio, 1.0) << row; // nodes cost more than none, rays more than Smith's formula
        } else if (baseline == "kernel-alone") {
            EXPECT_GT(ratio, 0.3) << row; // 0.8 and more on a quiet machine
        } else if (baseline == "same-context") {
            EXPECT_LT(ratio, 2.0) << row; // a context more, of one run
        } else if (name == "effects.none.n1") {
            EXPECT_GT(ratio, 0.7) << row; // about 1.5 on a quiet machine, and 3 with 8 lobes
        } else if (name == "effects.none.n8") {
            EXPECT_GT(ratio, 1.0) << row;
        } else if (baseline != "all-effects") { // of which some cost nothing, 10 times and more
            EXPECT_GT(ratio, 1.0) << row;
        }
    }
}

TEST(CliBench, SeveralDevicesAreRefused) {
    EXPECT_CLI_FAILS(1, "one device", {"bench", "--device", "0,0"});
    EXPECT_CLI_FAILS(2, "--rounds", {"bench", "--rounds"});
}
