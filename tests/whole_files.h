// Whether an output file is whole, by its ending: EXR, JSON (material files too), CSV, PNG and SVG.
#pragma once

#include <string>

#include "files.h"

namespace test {

// What is wrong with the file; empty: it can be read to its end.
std::string fault_of_file(const std::string &path);

// Each file of the folder is whole, but for temporary ones, whose names begin with a dot.
void expect_whole_files(const TempDir &dir);

} // namespace test
