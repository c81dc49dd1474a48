// The integrators of the API, and their scene and options from the flags that render and sheet share.
#pragma once

#include "flags.h"
#include "handles.h"

namespace slopemix::cli {

struct Rendering {
    Image image;
    smx_render_report report;
};

smx_scene scene(const RenderFlags &flags, const smx_displacement &displacement, double light_degrees);
smx_render_options render_options(const RenderFlags &flags);

Rendering render_filtered(const Context &context, const Material &material, const smx_scene &scene,
                          const smx_render_options &options);
Rendering render_reference(const Context &context, const Brdf &brdf, const smx_scene &scene,
                           const smx_render_options &options);
Rendering render_geometric(const Context &context, const Brdf &brdf, const smx_scene &scene,
                           const smx_render_options &options, const smx_geometric_options &geometric);
Rendering render_geometry(const Context &context, const smx_scene &scene, const smx_render_options &options);

// Without the compilation of kernels, which is paid once; 0 where there was nothing to evaluate.
double seconds_per_sample(double seconds, double build_seconds, std::uint64_t evaluations);

// Whether the device has the grade double.
bool takes_double(const Context &context);

} // namespace slopemix::cli
