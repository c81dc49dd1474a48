// Scenes and options of the C API as the library takes them.
#pragma once

#include "handles.h"
#include "integrate_geometric.h"
#include "integrate_reference.h"

namespace smx {

Displacement to_cpp(const smx_displacement &x);
Scene to_cpp(const smx_scene &scene);
GeometricOptions to_cpp(const smx_geometric_options &options);
RenderOptions to_cpp(const smx_render_options &options);
ProposalSource proposal_of(smx_brdf brdf);

} // namespace smx
