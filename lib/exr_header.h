// What an EXR file declares of its attributes, measured against the file.
#pragma once

#include <string>

namespace smx {

// OpenEXR takes the size of an attribute on trust, and allocates it. Throws BadFormat where one is longer than what the
// file has left, or other than its type's: OpenEXR reads by the type then, and takes what follows for names and sizes.
// What is no EXR file passes: OpenEXR says so itself.
void expect_sound_exr_header(const std::string &path);

} // namespace smx
