// An oracle for the tests: the formulas of the notation page (oracle_formulas.h) in long double, slow and written apart
// from the library, so that the two can disagree.
//   Beckmann slopes, their projected area, masking: Walter et al. 2007, Smith 1967 in the form of Dupuy et al. 2015.
//   A surface is a Gaussian of slopes; a mixture is a weighted sum of surfaces that share one displaced surface X.
#pragma once

#include <vector>

#include "oracle_formulas.h"
#include "vec3.h"

namespace oracle {

using Gaussian = GaussianOf<double>;

// From roughnesses: alpha is sqrt(2) times the standard deviation of the slope.
Gaussian gaussian(double alpha_x, double alpha_y, double rho = 0.0, double mean_x = 0.0, double mean_y = 0.0);

// `x` widened by an isotropic lobe of zero mean: covariances add.
Gaussian widened(const Gaussian &x, double alpha);

// Density over the slope plane, 1 over its integral. Needs a covariance of full rank.
double p22(const Gaussian &g, double slope_x, double slope_y);

// The exponent of p22 without its sign: half the squared Mahalanobis distance.
double exponent(const Gaussian &g, double slope_x, double slope_y);

// Distribution of normals, integral of ndf(m) m.z dm = 1 for a zero mean.
double ndf(const Gaussian &g, const Vec &wm);

// Projected area of the mean plane towards k: cos(theta_k) when the mean slope is 0.
double plane(const Gaussian &g, const Vec &k);

// Projected area of the surface towards k: E max(0, k.z - k.x x - k.y y) over its slopes.
double sigma(const Gaussian &g, const Vec &k);

double g1(const Gaussian &g, const Vec &k);

enum class Masking { correlated, separable, coinciding };

// Masking and shadowing from the plane's and the surface's projected areas.
// `coinciding` is min(G1(wi), G1(wo)): at wi = wo it is G1, as on real surfaces.
double g2(Masking masking, double plane_i, double sigma_i, double plane_o, double sigma_o);
double g2(Masking masking, const Gaussian &g, const Vec &wi, const Vec &wo);

struct Lobe {
    double weight = 1.0, alpha = 0.1;
};

// A material's lobes, each widened by the same X.
struct Mixture {
    std::vector<Lobe> lobes;
    Gaussian x; // all zeros: not displaced
};

double ndf(const Mixture &m, const Vec &wm);
double sigma(const Mixture &m, const Vec &k);
double g2(Masking masking, const Mixture &m, const Vec &wi, const Vec &wo);

// f cos(theta_i) with Fresnel 1. 0 where a direction is not above the macro surface or not above the mean plane.
double fcos(const Mixture &m, Masking masking, const Vec &wi, const Vec &wo);

// f alone, 1/sr.
double brdf(const Mixture &m, Masking masking, const Vec &wi, const Vec &wo);

// Radial slope density of lobes of zero mean, over the plane.
double radial_density(const std::vector<Lobe> &lobes, double slope);

} // namespace oracle
