// Whether a reference image on disk is the one that would be rendered now.
#pragma once

#include <filesystem>
#include <string>

#include "handles.h"

namespace slopemix::cli {

// The image in the file, if its "slopemix.*" attributes show that this version of the library made it from this table
// (by its SHA-256), scene and options; null otherwise, also without a readable file.
Image existing_reference(const std::filesystem::path &file, const std::string &sha256, const smx_scene &scene,
                         const smx_render_options &options);

} // namespace slopemix::cli
