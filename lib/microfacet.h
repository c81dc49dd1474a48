// Isotropic microfacet lobes with height-correlated Smith masking, on the host in double: for tables made from formulas
// and for figures about tables. The device's form is in cl/beckmann.clh. T is double, or Ceres's Jet where a derivative
// by alpha is wanted.
//   Walter, Marschner, Li, Torrance: "Microfacet Models for Refraction through Rough Surfaces" (EGSR 2007)
//   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (JCGT 2014)
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf.h"

namespace smx {

// Distributions of normals: the integral of ndf cos over the hemisphere is 1.
template <typename T>
T beckmann_ndf(double cos_h, const T &alpha) {
    using std::exp;
    const double cos2 = cos_h * cos_h, tan2 = (1.0 - cos2) / cos2;
    return exp(-tan2 / (alpha * alpha)) / (std::numbers::pi * alpha * alpha * cos2 * cos2);
}

template <typename T>
T ggx_ndf(double cos_h, const T &alpha) {
    const double cos2 = cos_h * cos_h;
    const T alpha2 = alpha * alpha, root = cos2 * alpha2 + (1.0 - cos2);
    return alpha2 / (std::numbers::pi * root * root);
}

inline double blinn_phong_ndf(double cos_h, double exponent) {
    return (exponent + 2.0) / (2 * std::numbers::pi) * std::pow(cos_h, exponent);
}

// Projected area of the microsurface towards a direction of this cosine.
template <typename T>
T beckmann_sigma(double cos_k, const T &alpha) {
    using std::erfc, std::exp;
    const T s = alpha * std::sqrt(std::max(1.0 - cos_k * cos_k, 0.0));
    if (cos_k >= 6.0 * s) return T(cos_k); // the rest is below a rounding of the cosine: exp(-36) s
    const T v = cos_k / s;
    return cos_k * erfc(-v) / 2.0 + s * exp(-v * v) / (2 * std::sqrt(std::numbers::pi));
}

template <typename T>
T ggx_sigma(double cos_k, const T &alpha) {
    using std::sqrt;
    const double cos2 = cos_k * cos_k;
    return (cos_k + sqrt(cos2 + alpha * alpha * std::max(1.0 - cos2, 0.0))) / 2.0;
}

// D G2 / (4 cos_i cos_o) from the distribution at the half vector and the projected areas of both directions.
template <typename T>
T smith_lobe(const Cosines &c, const T &ndf, const T &sigma_i, const T &sigma_o) {
    return ndf / (4.0 * (sigma_i * c.o + sigma_o * c.i - c.i * c.o));
}

// The same of one Beckmann lobe.
template <typename T>
T beckmann_lobe(const Cosines &c, const T &alpha) {
    return smith_lobe<T>(c, beckmann_ndf(c.h, alpha), beckmann_sigma(c.i, alpha), beckmann_sigma(c.o, alpha));
}

// The share of Schlick's Fresnel curve that does not depend on F0: F = F0 + (1 - F0) schlick_rise (Schlick 1994).
inline double schlick_rise(double cos_d) { return std::pow(1.0 - cos_d, 5); }
inline double schlick(double cos_d, double f0) { return f0 + (1.0 - f0) * schlick_rise(cos_d); }

} // namespace smx
