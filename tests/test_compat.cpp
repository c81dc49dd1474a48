// Files that released versions wrote are read as they were meant: tests/compat has a folder for each version.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cli.h"
#include "files.h"
#include "kept_files.h"

namespace {

using Json = nlohmann::ordered_json;

// A density's nodes and alpha, which compilers may round differently; what is only read is exact, and far within.
constexpr double double_tolerance = 1e-9;
// Of f cos in float32 (tests/test_eval.cpp), on whatever device.
constexpr double fcos_tolerance = 2e-5, fcos_floor = 1e-9;

std::vector<std::string> folders() {
    std::vector<std::string> list;
    for (const auto &entry : std::filesystem::directory_iterator(SLOPEMIX_COMPAT)) list.push_back(entry.path());
    return list;
}

void expect_same(const Json &expected, const Json &found, const std::string &path, double tolerance) {
    if (expected.is_object()) {
        for (const auto &[key, value] : expected.items()) // what later versions read beside it does not matter
            expect_same(value, found.is_object() ? found.value(key, Json()) : Json(), path + "." + key,
                        key == "fcos" ? fcos_tolerance : tolerance);
    } else if (expected.is_array()) {
        ASSERT_EQ(expected.size(), found.size()) << path;
        for (std::size_t k = 0; k < expected.size(); ++k)
            expect_same(expected[k], found[k], path + "[" + std::to_string(k) + "]", tolerance);
    } else if (expected.is_number_float()) {
        ASSERT_TRUE(found.is_number()) << path << " is " << found << ", not " << expected;
        const double wanted = expected;
        // Far out of a narrow lobe a float's exponential loses more than it keeps.
        const double floor = tolerance == fcos_tolerance ? fcos_floor : 0.0;
        EXPECT_LE(std::abs(found.get<double>() - wanted), tolerance * std::abs(wanted) + floor) << path;
    } else {
        EXPECT_EQ(expected, found) << path;
    }
}

} // namespace

TEST(Compat, EveryVersionsFilesReadAsTheyDid) {
    ASSERT_FALSE(folders().empty());
    for (const std::string &folder : folders()) {
        const Json expected = Json::parse(test::read_file(folder + "/expected.json"));
        ASSERT_GE(expected.size(), 4u) << folder;
        expect_same(expected, test::read_kept_files(folder), folder, double_tolerance);
    }
}

TEST(Compat, TheComparisonSeesADifference) {
    const Json expected = {{"fcos", {1.0, 2.0}}, {"name", "a"}, {"lobes", {{0.5, 0.1}}}};
    const auto differs = [&](const char *where, const Json &value) {
        Json other = expected;
        other[Json::json_pointer(where)] = value;
        ::testing::TestPartResultArray failures;
        {
            const ::testing::ScopedFakeTestPartResultReporter reporter(
                ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
            expect_same(expected, other, "$", double_tolerance);
        }
        return failures.size() > 0;
    };
    EXPECT_FALSE(differs("/fcos/1", 2.00001));
    EXPECT_TRUE(differs("/fcos/1", 2.0001));
    EXPECT_TRUE(differs("/fcos/1", nullptr));
    EXPECT_TRUE(differs("/name", "b"));
    EXPECT_TRUE(differs("/lobes/0/1", 0.10000001));
    EXPECT_TRUE(differs("/lobes/0", Json::array()));
}

// A row of another version is kept, and read by whatever adds to it.
TEST(Compat, TablesOfFitsGoOn) {
    for (const std::string &folder : folders()) {
        const test::TempDir out;
        std::filesystem::copy_file(folder + "/fits.json", out / "fits.json");
        const Json before = Json::parse(test::read_file(folder + "/fits.json")).at("materials");
        ASSERT_FALSE(before.empty()) << folder;
        test::write_file(out / "zz-new.csv", "theta,p22\n0,1\n0.1,0.5\n0.5,0\n");
        const test::CliResult run = test::cli(
            {"fit", "density:" + (out / "zz-new.csv"), "--model", "shared", "--lobes", "1", "--out", out.path()});
        ASSERT_CLI_OK(run);
        const Json after = Json::parse(test::read_file(out / "fits.json")).at("materials");
        ASSERT_EQ(after.size(), before.size() + 1) << folder;
        for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(before[k], after[k]) << folder << ", row " << k;
    }
}
