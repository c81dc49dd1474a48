// What the kernels of filtered shading are built with, and what they take of a material: lobes widened by X, curves,
// and where lobes are widened by an order, its nodes.
#pragma once

#include <string>
#include <vector>

#include "context.h"
#include "effects.h"
#include "grade.h"
#include "lobe_weights.h"

namespace smx {

// The kernels of filtered shading: all lobes in closed form, or each by its order.
struct FilteredKernels {
    bool widened;
    Defines defines;

    FilteredKernels(const Material &material, const Displacement &x, Effects on, const std::vector<int> &orders,
                    Grade grade);

    // `what` is sphere or pairs.
    cl::Kernel kernel(Context &device, const std::string &what) const;
};

cl::Buffer lobe_buffer(const Context &context, const Material &material, const Displacement &x, Grade grade,
                       LobeWeight which = LobeWeight::Model);

} // namespace smx
