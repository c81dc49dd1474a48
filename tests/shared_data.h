// Measured materials of ../shared, expanded to MERL tables once per build folder. Tests skip where they are not there.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace test {

// The table's path, or "" where the data or a Python with numpy is missing.
//   SLOPEMIX_SHARED  the folder of shared data, else beside the source
//   SLOPEMIX_PYTHON  a Python that has numpy
inline std::string measured_table(const std::string &material) {
    const char *shared_variable = std::getenv("SLOPEMIX_SHARED"), *python = std::getenv("SLOPEMIX_PYTHON");
    const std::filesystem::path shared = shared_variable ? shared_variable : SLOPEMIX_SHARED_DEFAULT;
    const std::filesystem::path tool = shared / "tools/expand_materials.py", folder = SLOPEMIX_TABLE_CACHE;
    if (python == nullptr || !std::filesystem::exists(tool)) return "";
    const std::filesystem::path table = folder / (material + ".binary");
    if (!std::filesystem::exists(table)) {
        std::ostringstream command;
        command << '\'' << python << "' " << tool << " --out " << folder << ' ' << material << " > /dev/null";
        if (std::system(command.str().c_str()) != 0) return "";
    }
    return table.string();
}

} // namespace test

#define SKIP_WITHOUT(table) \
    if ((table).empty())    \
    GTEST_SKIP() << "needs the shared data and a Python with numpy (SLOPEMIX_SHARED, SLOPEMIX_PYTHON)"
