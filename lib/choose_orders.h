// The widening's order of every lobe of an image: the one asked for, or the least that will do.
#pragma once

#include "widening.h"

namespace smx {

struct ChosenOrders {
    std::vector<int> orders;
    RenderReport cost; // of the choice: times only
};

// With widening_auto: some orders are tried on a few lit pixels, and the cheapest choice taken whose difference from
// the highest order, over these pixels, is within options.widening_tolerance.
ChosenOrders widening_orders(Context &context, const Material &material, const Scene &scene, Effects on,
                             const RenderOptions &options);

} // namespace smx
