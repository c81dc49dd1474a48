// The statistical reference, integrated deterministically to convergence:
//   L(i, o) = (1 / po) integral f(i_m, o_m) <i,m>+ <o,m>+ G2_X(i, o) D_X(m) dm
// over the slopes of the displaced surface X, with po the mean plane's projected area towards o.
#pragma once

#include <functional>

#include "oracle.h"
#include "oracle_table.h"

namespace oracle {

// f in the frame of a facet with normal wm, for directions given in the macro surface's frame.
using FacetBrdf = std::function<Rgb(const Vec &wi, const Vec &wo, const Vec &wm)>;

FacetBrdf table_brdf(const Table &table, Lookup how);

struct Integral {
    Rgb rgb{};
    double error = 0.0; // relative: the largest change of a channel when the nodes were doubled
};

// A facet's share in L for unit density of slopes: f <i,m>+ <o,m>+ / m.z, at the facet of the given slope.
Rgb facet_integrand(const FacetBrdf &f, const Vec &wi, const Vec &wo, double slope_x, double slope_y);

// X of rank 2 (a plane of slopes), 1 (one alpha is 0: a line) or 0 (the mean facet alone). A lobe of f narrower than
// about 1e-3 is beyond it.
Integral reference(const FacetBrdf &f, Masking masking, const Gaussian &x, const Vec &wi, const Vec &wo);

// The same by midpoints on a plain grid of slopes, n x n over 7 standard deviations: the check of the above.
Rgb reference_by_grid(const FacetBrdf &f, Masking masking, const Gaussian &x, const Vec &wi, const Vec &wo, int n);

} // namespace oracle
