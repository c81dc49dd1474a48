// The displaced surface and the experiment's sphere, as the host knows them, and their structs on the device.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace smx {

// Gaussian density of slopes; alphas are sqrt(2) times the standard deviations.
struct Displacement {
    double alpha_x = 0.0, alpha_y = 0.0;
    double rho = 0.0;
    double mean_slope_x = 0.0, mean_slope_y = 0.0;

    bool operator==(const Displacement &) const = default;
};

// The surface that has the slopes of both, which are independent: means and covariances add. Throws InvalidArgument
// where an alpha or a mean slope leaves its range.
Displacement operator+(const Displacement &x, const Displacement &y);

enum class Masking { Correlated = 0, Separable = 1 };

// One direction of unit perpendicular irradiance, or radiance 1 from every direction above the surface.
enum class Light { Directional = 0, Uniform = 1 };

struct Scene {
    std::uint32_t width = 128, height = 128;
    double light_phi = 0.0;
    Displacement displacement;
    Masking masking = Masking::Correlated;
    Light light = Light::Directional;

    bool operator==(const Scene &) const = default;
};

constexpr std::uint32_t max_side = 16384;

// Throw InvalidArgument, naming value and range.
void validate(const Displacement &displacement);
void validate(Masking masking);
void validate(const Scene &scene);

// Throws InvalidArgument for another light: what is written for one direction takes no other.
void require_directional(const Scene &scene);

// As in cl/displacement.clh; Real is float, or double in the grade of that name (grade.h).
template <typename Real = float>
struct DeviceDisplacement {
    Real mean_x, mean_y;
    Real axis_x, axis_y;
    Real var_1, var_2;
};

// As in cl/sphere.clh.
template <typename Real = float>
struct DeviceView {
    std::int32_t width, height;
    Real inv_side;
    Real wi_x, wi_y;
    Real wh_x, wh_y;
};

// Principal axes of the covariance, in double before they are rounded; exact at any ratio of the alphas and any rho.
struct PrincipalAxes {
    double axis_x, axis_y; // unit vector along the first
    double var_1, var_2;   // twice the variances: alphas squared
};
PrincipalAxes principal_axes(const Displacement &displacement);

// The same with a variance of 0 where X alone is as good as smooth: for facets that are drawn, and quadratures over
// them.
PrincipalAxes rough_principal_axes(const Displacement &displacement);

template <typename Real = float>
DeviceDisplacement<Real> to_device(const Displacement &displacement);
template <typename Real = float>
DeviceView<Real> to_device(const Scene &scene);

// Half the angle between light and view, 0..pi/2: one for the whole image.
double theta_d(const Scene &scene);

// Pixels whose centre lies on the sphere; of them, those that are turned towards the light.
std::uint64_t sphere_pixels(const Scene &scene);
std::uint64_t lit_pixels(const Scene &scene);

// wi and wo of a pixel in its frame (e_theta, e_phi, normal); nothing where its centre is off the sphere or not lit.
struct LocalDirections {
    std::array<double, 3> wi, wo;
};
std::optional<LocalDirections> lit_pixel(const Scene &scene, std::uint32_t column, std::uint32_t row);

} // namespace smx
