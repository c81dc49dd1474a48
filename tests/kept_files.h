// What the library reads in a folder of files that a version wrote, as JSON: tests/compat/VERSION/expected.json is this
// of the version that wrote the folder, and later versions have to read the same.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace test {

// Materials (*.json but for expected.json and fits.json), densities (*.csv) and images (*.exr) by their names.
// f cos, under "fcos", is float32's; all else is exact or double's.
nlohmann::ordered_json read_kept_files(const std::string &folder);

} // namespace test
