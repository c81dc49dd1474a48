// Batches of quick fits by the command: their tables, their arguments, and their rows in fits.json.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli.h"
#include "files.h"

namespace test {

// Tables of these names, all the same; links, since each would take 35 MB.
inline std::vector<std::string> make_tables(const TempDir &dir, const std::vector<std::string> &names,
                                            const char *builtin = "builtin:conductor") {
    std::vector<std::string> tables;
    for (const std::string &name : names) {
        tables.push_back(dir / (name + ".binary"));
        if (tables.size() == 1)
            EXPECT_EQ(cli({"synth", builtin, "--out", tables[0]}).status, 0);
        else
            std::filesystem::create_hard_link(tables[0], tables.back());
    }
    return tables;
}

// A quick fit of these tables to dir/out.
inline std::vector<std::string> fit_of(const TempDir &dir, const std::vector<std::string> &tables,
                                       const std::vector<std::string> &more = {}) {
    std::vector<std::string> arguments = with({"fit", "--out", dir / "out", "--model", "shared"}, more);
    if (std::find(more.begin(), more.end(), "--lobes") == more.end()) arguments = with(arguments, {"--lobes", "2"});
    return with(arguments, tables);
}

inline nlohmann::json rows_in(const TempDir &dir) {
    return nlohmann::json::parse(read_file(dir / "out/fits.json")).at("materials");
}

inline std::vector<std::string> names_in(const nlohmann::json &rows) {
    std::vector<std::string> names;
    for (const nlohmann::json &row : rows) names.push_back(row.at("name"));
    return names;
}

} // namespace test
