#include "fit_slice.h"

#include <cmath>
#include <numbers>

namespace slopemix::cli {

namespace {

constexpr double theta_i = 45.0;
constexpr int steps = 600; // of the square root of the half angle, from 0 to 90 degrees

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// theta_h = u^2 90 degrees on either side of the mirror direction; theta_o moves by twice that.
std::vector<double> angles_out() {
    std::vector<double> angles;
    for (int k = -steps; k <= steps; ++k) {
        const double u = static_cast<double>(k) / steps;
        const double theta_o = theta_i + 180.0 * u * std::abs(u);
        if (std::abs(theta_o) < 90.0) angles.push_back(theta_o);
    }
    return angles;
}

struct Pairs {
    std::vector<float> wi, wo;
    std::size_t count() const { return wi.size() / 3; }
};

Pairs pairs_of(const std::vector<double> &angles) {
    Pairs pairs;
    const auto add = [](std::vector<float> &list, double angle) {
        for (const double v : {std::sin(angle), 0.0, std::cos(angle)}) list.push_back(static_cast<float>(v));
    };
    for (const double angle : angles) {
        add(pairs.wi, radians(theta_i));
        add(pairs.wo, -radians(angle));
    }
    return pairs;
}

} // namespace

std::vector<std::vector<double>> slice_at_45_degrees(const Context &context, const Brdf &brdf,
                                                     const std::vector<const Material *> &materials) {
    const std::vector<double> angles = angles_out();
    const Pairs pairs = pairs_of(angles);
    std::vector<std::vector<double>> rows;
    for (const double angle : angles) rows.push_back({angle});
    std::vector<float> f(3 * pairs.count());
    const auto append = [&](double factor) {
        for (std::size_t k = 0; k < f.size(); ++k) rows[k / 3].push_back(factor * static_cast<double>(f[k]));
    };

    check(smx_brdf_eval(context.get(), brdf.get(), SMX_LOOKUP_LINEAR, pairs.count(), pairs.wi.data(), pairs.wo.data(),
                        f.data()));
    append(1.0);
    const smx_displacement none = {};
    for (const Material *material : materials) {
        check(smx_material_eval(context.get(), material->get(), &none, SMX_G2_CORRELATED, nullptr, pairs.count(),
                                pairs.wi.data(), pairs.wo.data(), f.data()));
        append(1.0 / std::cos(radians(theta_i)));
    }
    return rows;
}

} // namespace slopemix::cli
