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

Displacement operator+(const Displacement &x, const Displacement &y) {
    validate(x);
    validate(y);
    Displacement sum = {std::hypot(x.alpha_x, y.alpha_x), std::hypot(x.alpha_y, y.alpha_y), 0.0,
                        x.mean_slope_x + y.mean_slope_x, x.mean_slope_y + y.mean_slope_y};
    if (sum.alpha_x > 0.0 && sum.alpha_y > 0.0) {
        // By shares of the alphas, whose products may be too small for a number.
        const auto share = [&](const Displacement &d) {
            return d.rho * (d.alpha_x / sum.alpha_x) * (d.alpha_y / sum.alpha_y);
        };
        // The sum's slopes are no more correlated than either's (Cauchy, Schwarz); roundings could make them so.
        const double most = std::max(std::abs(x.rho), std::abs(y.rho));
        sum.rho = std::clamp(share(x) + share(y), -most, most);
    }
    validate(sum);
    return sum;
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
    require(s.light == Light::Directional, "light is 1 (uniform); here it must be 0 (directional)");
}

PrincipalAxes principal_axes(const Displacement &x) {
    const double xx = x.alpha_x * x.alpha_x, yy = x.alpha_y * x.alpha_y, xy = x.rho * x.alpha_x * x.alpha_y;
    if (xy == 0.0) return {1.0, 0.0, xx, yy};
    // The larger root by a sum, the smaller as the determinant over it, so that neither cancels.
    const double half = (xx - yy) / 2, radius = std::hypot(half, xy);
    const double larger = (xx + yy) / 2 + radius, smaller = xx * yy * (1.0 - x.rho) * (1.0 + x.rho) / larger;
    // The first axis is along (xx - smaller, xy) and (xy, yy - smaller): the one whose difference is the larger.
    const double along = std::abs(half) + radius, length = std::hypot(along, xy);
    if (half >= 0.0) return {along / length, xy / length, larger, smaller};
    return {xy / length, along / length, larger, smaller};
}

namespace {

// A variance this small (an alpha of 1e-9) is none: it is lost beside any lobe's, of alpha 1e-4 at the least, and its
// density would leave the range of a float.
double significant(double variance) { return variance < 1e-18 ? 0.0 : variance; }

} // namespace

PrincipalAxes rough_principal_axes(const Displacement &x) {
    const auto [axis_x, axis_y, var_1, var_2] = principal_axes(x);
    return {axis_x, axis_y, significant(var_1), significant(var_2)};
}

template <typename Real>
DeviceDisplacement<Real> to_device(const Displacement &x) {
    const PrincipalAxes axes = principal_axes(x);
    const auto f = [](double v) { return static_cast<Real>(v); };
    return {f(x.mean_slope_x), f(x.mean_slope_y), f(axes.axis_x), f(axes.axis_y), f(axes.var_1), f(axes.var_2)};
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
