// A fitted material: zero-mean isotropic Beckmann lobes and Fresnel curves, in one of two models:
//   shared    f = F(theta_d) sum_k w_k D_k(wh) G2(wi, wo) / (4 cos_i cos_o), the thesis's
//   per-lobe  f = sum_k F_k(theta_d) D_k(wh) G2_k(wi, wo) / (4 cos_i cos_o)
#pragma once

#include <array>
#include <string>
#include <vector>

#include "slope_density.h"

namespace smx {

constexpr std::size_t max_lobes = 64;
constexpr double max_fresnel = 1e20; // a float's range, with room for the product with a density
constexpr double min_alpha = 1e-4, max_alpha = 1e4;

enum class Model { Shared = 0, PerLobe = 1 };

std::string model_name(Model model); // "shared", "per-lobe"

struct Lobe {
    double weight; // share of the mixture; in the per-lobe model, of the energy (energy_shares)
    double alpha;
};

// Of a fitted curve over theta_d (fit/curve_basis.h).
constexpr std::size_t curve_coefficients = 13;

// Of a fit's report on the directional albedo (fit/directional_albedo.h).
constexpr std::size_t albedo_angles = 8;

// Standard deviations of the per-lobe model's parameters; empty where there are none.
struct Deviations {
    static constexpr double held = -1.0; // at a bound: the parameter was not free

    std::vector<double> alpha;                              // by lobe
    std::vector<std::array<std::vector<double>, 3>> curves; // of the curves' coefficients: by lobe, channel
};

// Share of the light from a direction that is reflected: of the table and of the fit, by theta_o, channel.
struct AlbedoReport {
    std::vector<double> theta_o; // radians
    std::vector<Rgb> table, fit;
};

struct FitReport {
    unsigned inversion_iterations = 0, em_iterations = 0, refine_iterations = 0;
    double log_likelihood_em = 0.0, log_likelihood = 0.0;
    double residual_em = 0.0, residual = 0.0;
    std::string refine_message;
    // Of the per-lobe model.
    unsigned curve_iterations = 0;
    double brdf_residual_start = 0.0, brdf_residual = 0.0;
    double displaced_share = 0.0; // of the displaced surfaces in the residuals, beside the base's 1
    std::string curve_message;
    // relRMSE on spheres under three lights, estimated on the host: of the base alone, mean over displaced ones, and
    // the latter of the shared model with as many lobes.
    double base_relrmse = 0.0, displaced_relrmse = 0.0, displaced_relrmse_shared = 0.0;
    std::string choice;         // why this number of lobes or this start, where there was a choice
    double seconds = 0.0;       // of EM, the start and the refinements
    double check_seconds = 0.0; // of the figures about the fit: the three above and the two below
    Deviations deviations;
    AlbedoReport albedo;
};

struct Material {
    std::string name, source, sha256;
    Model model = Model::Shared;
    std::vector<Lobe> lobes;            // in ascending alpha, weights summing to 1
    std::vector<double> theta_d;        // knots of the curves, ascending from 0 to pi/2
    std::vector<FresnelCurves> fresnel; // one set, or one per lobe
    FitReport report;
};

// theta_d = k pi/2 / (knots - 1).
std::vector<double> uniform_knots(std::size_t knots);

// Shares of the lobes' energy: mean over the channels of the integral of F_k sin(2 theta_d), summing to 1.
std::vector<double> energy_shares(const std::vector<double> &theta_d, const std::vector<FresnelCurves> &fresnel);

// Throws InvalidArgument, naming the value, unless lobes and curves are within their ranges.
void validate(const Material &material);

// Normalises the weights and sorts by alpha; of a material, the curves with their lobes.
void canonicalise(std::vector<Lobe> &lobes);
void canonicalise(Material &material);

// F of one set of curves at an angle in 0..pi/2, linear between the knots.
Rgb fresnel_at(const std::vector<double> &knots, const FresnelCurves &curves, double theta_d);

} // namespace smx
