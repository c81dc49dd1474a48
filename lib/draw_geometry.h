// Launch of cl/draw_geometry.cl: a picture of the displaced sphere.
#pragma once

#include "render.h"

namespace smx {

Rendered draw_geometry(Context &context, const Scene &scene, const RenderOptions &options);

} // namespace smx
