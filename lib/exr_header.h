// What an EXR file declares of itself, measured against the file.
#pragma once

#include <string>

namespace smx {

// OpenEXR's readers in C++ take the sizes in a header on trust and allocate them; its core library does not. Throws
// BadFormat where the core refuses the header: a part longer than the file, or an image with a side above max_side.
void expect_sound_exr_header(const std::string &path);

} // namespace smx
