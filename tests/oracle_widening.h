// The statistical reference (oracle_reference.h) of a base that is itself a sum of lobes, by adaptive cubature: it
// holds for lobes as sharp as 1e-4 and as wide as 20, and for surfaces smooth along an axis or nearly so. What a
// widening of any order converges to.
#pragma once

#include "oracle_reference.h"

namespace oracle {

// How the base's lobes mask: all by one mixture, or each by itself. Weights are shares of the mixture in one and
// Fresnel factors in the other.
enum class Base { shared, per_lobe };

// f of the base in the facet's frame, the same for the three channels.
FacetBrdf lobes_brdf(Base base, const std::vector<Lobe> &lobes, Masking masking);

struct Estimate {
    double value = 0.0, error = 0.0; // both absolute
};

// f cos(theta_i) of the base seen on X, of full rank, on a line, or at a point. 0 as oracle::fcos is.
Estimate widened_fcos(Base base, const std::vector<Lobe> &lobes, Masking masking, const Gaussian &x, const Vec &wi,
                      const Vec &wo);

} // namespace oracle
