// OUT/fits.json and OUT/fits.csv: a row per material, of this run and of earlier ones, sorted by name.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace slopemix::cli {

class FitTable {
  public:
    using Row = nlohmann::ordered_json;

    // Reads `folder`/fits.json where it exists. Throws CommandError, with what is wrong, where it is no such table:
    // rows of earlier runs are not to be lost.
    explicit FitTable(const std::filesystem::path &folder);

    // The row of this name, or nullptr.
    const Row *find(const std::string &name) const;

    // Puts a row in its place by its "name"; save() writes both files, atomically, where their content changes.
    void put(const Row &row);
    void save() const;

    static std::filesystem::path json_in(const std::filesystem::path &folder) { return folder / "fits.json"; }
    static std::filesystem::path csv_in(const std::filesystem::path &folder) { return folder / "fits.csv"; }

  private:
    std::filesystem::path folder_;
    std::map<std::string, Row> rows_;
};

} // namespace slopemix::cli
