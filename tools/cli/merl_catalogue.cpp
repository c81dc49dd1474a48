#include "merl_catalogue.h"

#include "merl_materials.h"

namespace slopemix::cli {

std::span<const MerlMaterial> merl_catalogue() { return merl_materials; }

} // namespace slopemix::cli
