// slopemix materials: the catalogue, and the tables of a folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cli.h"
#include "files.h"

using nlohmann::json;

namespace {

json materials(const std::vector<std::string> &more = {}) {
    const test::CliResult run = test::cli(test::with({"materials", "--json"}, more));
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
}

const json &named(const json &list, const std::string &name) {
    return *std::find_if(list.begin(), list.end(), [&](const json &item) { return item.at("name") == name; });
}

} // namespace

TEST(CliMaterials, TheDocumentsHundred) {
    const json list = materials();
    ASSERT_EQ(list.size(), 100u);
    int listed = 0;
    std::set<std::string> names;
    std::map<std::string, int> kinds;
    for (std::size_t k = 0; k < list.size(); ++k) {
        const json &material = list[k];
        EXPECT_EQ(material.at("number"), k + 1);
        EXPECT_EQ(material.at("file"), material.at("name").get<std::string>() + ".binary");
        EXPECT_TRUE(material.at("present").is_null());
        listed += material.at("listed").get<bool>();
        names.insert(material.at("name"));
        ++kinds[material.at("kind")];
    }
    EXPECT_EQ(listed, 89);
    EXPECT_EQ(names.size(), 100u);
    for (const auto &[kind, count] : kinds) EXPECT_GE(count, 4) << kind;
    EXPECT_EQ(named(list, "gold-paint").at("number"), 32);
    EXPECT_EQ(named(list, "yellow-plastic").at("number"), 100);
    EXPECT_FALSE(named(list, "cherry-235").at("listed").get<bool>());
    EXPECT_EQ(named(list, "chrome").at("kind"), "metal");
}

TEST(CliMaterials, TablesOfAFolder) {
    const test::TempDir dir;
    for (const char *file : {"chrome.binary", "ours.binary", "brass.txt"}) test::write_file(dir / file, "");
    const json list = materials({dir.path()});
    ASSERT_EQ(list.size(), 101u);
    EXPECT_TRUE(named(list, "chrome").at("present").get<bool>());
    EXPECT_FALSE(named(list, "brass").at("present").get<bool>());
    EXPECT_EQ(list[100].at("name"), "ours");
    EXPECT_TRUE(list[100].at("number").is_null());
    EXPECT_TRUE(list[100].at("present").get<bool>());
    const test::CliResult text = test::cli({"materials", dir.path()});
    ASSERT_CLI_OK(text);
    EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), 102);
}

TEST(CliMaterials, BadFoldersAreNamed) {
    const test::TempDir dir;
    test::write_file(dir / "file", "");
    EXPECT_CLI_FAILS(1, "no-such", {"materials", dir / "no-such"});
    EXPECT_CLI_FAILS(1, "Not a directory", {"materials", dir / "file"});
}
