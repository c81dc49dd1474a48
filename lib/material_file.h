// Material files: JSON, format "slopemix-material", version 1 (docs/material-format.md).
#pragma once

#include <string>

#include "material.h"

namespace smx {

// Throws CannotRead, or BadFormat with the path of the offending key.
Material load_material(const std::string &path);

// Writes the file, whole or not at all. Throws CannotWrite.
void save_material(const Material &material, const std::string &path);

} // namespace smx
