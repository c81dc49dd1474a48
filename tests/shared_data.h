// Measured materials of ../shared, expanded to MERL tables once per build folder. Tests skip where they are not there.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "files.h"

namespace test {

// The table's path, or "" where the data or a Python with numpy is missing.
//   SLOPEMIX_SHARED  the folder of shared data, else beside the source
//   SLOPEMIX_PYTHON  a Python that has numpy
inline std::string measured_table(const std::string &material) {
    const char *shared_variable = std::getenv("SLOPEMIX_SHARED"), *python = std::getenv("SLOPEMIX_PYTHON");
    const std::string shared = shared_variable ? shared_variable : SLOPEMIX_SHARED_DEFAULT;
    const std::string tool = shared + "/tools/expand_materials.py";
    if (python == nullptr || !exists(tool)) return "";
    const std::string folder = SLOPEMIX_TABLE_CACHE, table = folder + "/" + material + ".binary";
    const std::string command =
        "'" + std::string(python) + "' '" + tool + "' --out '" + folder + "' " + material + " > /dev/null";
    if (!exists(table) && std::system(command.c_str()) != 0) return "";
    return exists(table) ? table : "";
}

}  // namespace test

#define SKIP_WITHOUT(table)                                                                        \
    if ((table).empty())                                                                           \
    GTEST_SKIP() << "needs the shared data and a Python with numpy (SLOPEMIX_SHARED, SLOPEMIX_PYTHON)"
