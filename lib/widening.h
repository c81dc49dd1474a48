// What cl/widen.clh takes of a material and a displaced surface: its facets in principal axes, its lobes with the model
// that places their nodes, and the nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "material.h"
#include "render.h"

namespace smx {

// Of a widening: 0 the closed form, n >= 1 the quadrature of n x n nodes, or the least that will do (choose_orders.h).
constexpr int max_widening_order = 8, widening_auto = -1;

// Throws InvalidArgument, naming value and range.
void validate_widening(const RenderOptions &options);

// Axes along which the surface is rough, 0..2: where there is none, nothing is to be integrated.
int rough_axes(const Displacement &displacement);

// The same order for every lobe; 0 where the surface is smooth.
std::vector<int> fixed_orders(const Material &material, const Displacement &displacement, int order);

// Sets a kernel's arguments from `first` on: facets, lobes, nodes. Returns the buffers, to be kept while it runs.
std::vector<cl::Buffer> set_widening(const Context &context, cl::Kernel &kernel, cl_uint first,
                                     const Material &material, const Displacement &displacement,
                                     const std::vector<int> &orders, Grade grade);

} // namespace smx
