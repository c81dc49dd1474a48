// Structs of slopemix.h as the library has them. They are not yet validated, but for what C alone can get wrong.
#pragma once

#include "error.h"
#include "render.h"
#include "scene.h"
#include "slopemix.h"

namespace smx {

inline Displacement to_cpp(const smx_displacement &x) {
    return {x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y};
}

inline Scene to_cpp(const smx_scene &s) {
    return {s.width,
            s.height,
            s.light_phi,
            to_cpp(s.displacement),
            static_cast<Masking>(s.masking),
            static_cast<Light>(s.light)};
}

inline RenderOptions to_cpp(const smx_render_options &o) {
    RenderOptions out;
    out.sampler = static_cast<Sampler>(o.sampler);
    out.spp = o.spp;
    out.seed = o.seed;
    out.lookup = static_cast<Lookup>(o.lookup);
    out.target_error = o.target_error;
    out.grade = static_cast<Grade>(o.grade);
    out.widening_order = o.widening_order;
    out.widening_tolerance = o.widening_tolerance;
    out.effects = o.effects;
    out.effect_tolerance = o.effect_tolerance;
    out.errors = o.errors != 0;
    out.whole_table = o.whole_table != 0;
    if (o.exr_path) out.exr_path = o.exr_path;
    require(!o.exr_path || *o.exr_path, "exr_path is empty; it must be a file's path or null");
    if (o.progress)
        out.progress = [call = o.progress, user = o.progress_user](double share) { return call(user, share) != 0; };
    return out;
}

} // namespace smx
