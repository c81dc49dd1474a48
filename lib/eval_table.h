// Launch of cl/eval_table.cl: a measured table at pairs of directions.
#pragma once

#include "brdf.h"
#include "render.h"

namespace smx {

// f, not times a cosine, for `count` pairs of directions; wi, wo, f are [count][3], packed. 0 where either direction is
// not above the surface.
void eval_table(Context &context, const Brdf &brdf, Lookup lookup, std::size_t count, const float *wi, const float *wo,
                float *f);

} // namespace smx
