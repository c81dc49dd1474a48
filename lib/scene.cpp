#include "scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.h"

namespace smx {

namespace {

constexpr double max_displacement = 1e4;

void validate_alpha(const char *name, double alpha) {
    require(alpha >= 0.0 && alpha <= max_displacement, name, " is ", alpha, "; it must be 0..", max_displacement);
}

void validate_mean(const char *name, double slope) {
    require(std::abs(slope) <= max_displacement, name, " is ", slope, "; it must be -", max_displacement, "..",
            max_displacement);
}

} // namespace

void validate(const Displacement &x) {
    validate_alpha("alpha_x", x.alpha_x);
    validate_alpha("alpha_y", x.alpha_y);
    require(std::abs(x.rho) < 1.0, "rho is ", x.rho, "; it must be above -1 and below 1");
    validate_mean("mean_slope_x", x.mean_slope_x);
    validate_mean("mean_slope_y", x.mean_slope_y);
}

void validate(Masking masking) {
    require(masking == Masking::Correlated || masking == Masking::Separable, "masking is ", static_cast<int>(masking),
            "; it must be 0 or 1");
}

void validate(const Scene &s) {
    require(s.width >= 1 && s.width <= max_side, "width is ", s.width, "; it must be 1..", max_side);
    require(s.height >= 1 && s.height <= max_side, "height is ", s.height, "; it must be 1..", max_side);
    require(std::isfinite(s.light_phi), "light_phi is ", s.light_phi, "; it must be finite");
    validate(s.masking);
    validate(s.displacement);
    require(s.light == Light::Directional || s.light == Light::Uniform, "light is ", static_cast<int>(s.light),
            "; it must be 0 or 1");
}

void require_directional(const Scene &s) {
    require(s.light == Light::Directional, "light is 1 (uniform); this integrator takes only 0 (directional)");
}

namespace {

// A variance this small (an alpha of 1e-9) is none: it is lost beside any lobe's, of alpha 1e-4 at the least, and its
// density would leave the range of a float.
double significant(double variance) { return variance < 1e-18 ? 0.0 : variance; }

} // namespace

PrincipalAxes principal_axes(const Displacement &x) {
    const double xx = significant(x.alpha_x * x.alpha_x), yy = significant(x.alpha_y * x.alpha_y);
    const double xy = xx > 0.0 && yy > 0.0 ? x.rho * x.alpha_x * x.alpha_y : 0.0;
    if (xy == 0.0) return {1.0, 0.0, xx, yy};
    // The larger root by a sum, the smaller as the determinant over it, so that neither cancels.
    const double half = (xx - yy) / 2, radius = std::hypot(half, xy);
    const double larger = (xx + yy) / 2 + radius, smaller = xx * yy * (1.0 - x.rho) * (1.0 + x.rho) / larger;
    const double angle = std::atan2(xy, half) / 2;
    return {std::cos(angle), std::sin(angle), larger, significant(smaller)};
}

template <typename Real>
DeviceDisplacement<Real> to_device(const Displacement &x) {
    const PrincipalAxes axes = principal_axes(x);
    const auto f = [](double v) { return static_cast<Real>(v); };
    return {f(x.mean_slope_x),
            f(x.mean_slope_y),
            f(x.alpha_x * x.alpha_x),
            f(x.rho * x.alpha_x * x.alpha_y),
            f(x.alpha_y * x.alpha_y),
            f(axes.axis_x),
            f(axes.axis_y),
            f(axes.var_1),
            f(axes.var_2)};
}

template DeviceDisplacement<float> to_device(const Displacement &);
template DeviceDisplacement<double> to_device(const Displacement &);

namespace {

// Angle from the view direction (phi = pi/2) to the light, -pi..pi.
double view_to_light(const Scene &s) {
    return std::remainder(s.light_phi - std::numbers::pi / 2, 2 * std::numbers::pi);
}

} // namespace

double theta_d(const Scene &s) { return std::abs(view_to_light(s)) / 2; }

template <typename Real>
DeviceView<Real> to_device(const Scene &s) {
    const double turn = view_to_light(s);
    const auto f = [](double v) { return static_cast<Real>(v); };
    return {static_cast<std::int32_t>(s.width),
            static_cast<std::int32_t>(s.height),
            f(1.0 / std::min(s.width, s.height)),
            f(-std::sin(turn)),
            f(std::cos(turn)),
            f(-std::sin(turn / 2)),
            f(std::cos(turn / 2))};
}

template DeviceView<float> to_device(const Scene &);
template DeviceView<double> to_device(const Scene &);

namespace {

// Calls visit(right, depth2) for the centre of every pixel on the sphere: its offset and the square of its depth
// towards the viewer, in half pixels.
template <typename Visit>
void visit_sphere(const Scene &s, Visit visit) {
    const std::int64_t side = std::min(s.width, s.height), width = s.width, height = s.height;
    for (std::int64_t up = 1 - height; up < height; up += 2) {
        const std::int64_t left2 = side * side - up * up;
        // From the first offset of the pixels' parity that lies within.
        std::int64_t first = left2 > 0 ? -static_cast<std::int64_t>(std::sqrt(static_cast<double>(left2 - 1))) : 0;
        if ((first + width) % 2 == 0) ++first;
        for (std::int64_t right = first; right * right < left2; right += 2) visit(right, left2 - right * right);
    }
}

} // namespace

std::uint64_t sphere_pixels(const Scene &s) {
    std::uint64_t count = 0;
    visit_sphere(s, [&](std::int64_t, std::int64_t) { ++count; });
    return count;
}

std::uint64_t lit_pixels(const Scene &s) {
    const DeviceView view = to_device<float>(s);
    std::uint64_t count = 0;
    visit_sphere(s, [&](std::int64_t right, std::int64_t depth2) {
        const double cos_i =
            view.wi_x * static_cast<double>(right) + view.wi_y * std::sqrt(static_cast<double>(depth2));
        count += cos_i > 0.0;
    });
    return count;
}

std::optional<LocalDirections> lit_pixel(const Scene &s, std::uint32_t column, std::uint32_t row) {
    const double turn = view_to_light(s), side = std::min(s.width, s.height);
    const double nx = (2.0 * column + 1.0 - s.width) / side, nz = (s.height - 2.0 * row - 1.0) / side;
    const double depth2 = 1.0 - nx * nx - nz * nz;
    if (depth2 <= 0.0) return {};
    const double ny = std::sqrt(depth2), sin_theta = std::hypot(nx, ny); // not 0, since ny is not
    const double cos_phi = nx / sin_theta, sin_phi = ny / sin_theta;
    const auto local = [&](double wx, double wy) -> std::array<double, 3> {
        return {nz * (cos_phi * wx + sin_phi * wy), cos_phi * wy - sin_phi * wx, nx * wx + ny * wy};
    };
    const LocalDirections d = {local(-std::sin(turn), std::cos(turn)), local(0.0, 1.0)};
    if (d.wi[2] <= 0.0) return {};
    return d;
}

} // namespace smx
