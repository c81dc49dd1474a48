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

// As in cl/facet_chart.clh, cl/facet_peak.clh and cl/widen.clh.
template <typename Real>
struct DeviceFacets {
    Real axis_x, axis_y, mean_1, mean_2, alpha_1, alpha_2, inv_alpha_1, inv_alpha_2, n_x, n_y, n_z, flatness;
};

template <typename Real>
struct DeviceQuadratureLobe {
    std::int32_t order, nodes, steps, spare;
    Real alpha2, inv_alpha2, peak;
    Real half_turn_h, half_turn_z, half_masked;
    Real sigma_0, fall;
    Real towards_mean_1, towards_mean_2, reach2;
};

template <typename Real>
struct DeviceNode {
    Real z, weight;
};

template <typename Real>
DeviceFacets<Real> device_facets(const Displacement &displacement);

// One entry per order, of the material's lobes in turn.
template <typename Real>
std::vector<DeviceQuadratureLobe<Real>> quadrature_lobes(const Material &material, const std::vector<int> &orders,
                                                         const Displacement &displacement);

// The nodes of all orders from 1, one after another, as quadrature_lobes points at them.
template <typename Real>
std::vector<DeviceNode<Real>> hermite_nodes();

// Sets a kernel's arguments from `first` on: facets, lobes, nodes. Returns the buffers, to be kept while it runs.
std::vector<cl::Buffer> set_widening(const Context &context, cl::Kernel &kernel, cl_uint first,
                                     const Material &material, const Displacement &displacement,
                                     const std::vector<int> &orders, Grade grade);

} // namespace smx
