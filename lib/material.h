// A fitted material: a mixture of zero-mean isotropic Beckmann lobes under one Fresnel curve per channel (the thesis's
// `shared` model): f = F(theta_d) sum_k w_k D_k(wh) G2(wi, wo) / (4 cos_i cos_o).
#pragma once

#include <string>
#include <vector>

#include "slope_density.h"

namespace smx {

constexpr std::size_t max_lobes = 64;
constexpr double min_alpha = 1e-4, max_alpha = 1e4;

struct Lobe {
    double weight, alpha;
};

struct FitReport {
    unsigned inversion_iterations = 0, em_iterations = 0, refine_iterations = 0;
    double log_likelihood_em = 0.0, log_likelihood = 0.0;
    double residual_em = 0.0, residual = 0.0;
    double seconds = 0.0;
    std::string refine_message;
};

struct Material {
    std::string name, source, sha256;
    std::vector<Lobe> lobes;  // in ascending alpha, weights summing to 1
    FresnelCurves fresnel;
    FitReport report;
};

// Throws InvalidArgument, naming the value, unless lobes and curves are within their ranges.
void validate(const Material &material);

// Normalises the weights and sorts by alpha.
void canonicalise(std::vector<Lobe> &lobes);

// F at an angle in 0..pi/2, linear between the knots.
Rgb fresnel_at(const FresnelCurves &curves, double theta_d);

}  // namespace smx
