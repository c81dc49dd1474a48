// Slopes that are drawn, by the inverse of their distributions, in any arithmetic (oracle_formulas.h). A root is found
// in double and refined in T by Newton's steps, which give numbers that carry derivatives those of the implicit
// function.
//   Heitz, d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals"
#pragma once

#include <algorithm>

#include "oracle_formulas.h"

namespace oracle {

// Of slopes of the density exp(-t^2) / sqrt(pi), all of them.
struct AllSlopes {
    template <class T>
    static T share_below(const T &t) {
        using std::erfc;
        return erfc(T(0.0) - t) / T(2.0);
    }
    template <class T>
    static T density(const T &t) {
        using std::exp, std::sqrt;
        return exp(T(0.0) - t * t) / sqrt(pi_of<T>());
    }
};

// Of those along the direction to a viewer at v = p/s, by what is seen of them: (v - t) exp(-t^2), t < v.
template <class T>
struct SlopesSeen {
    T v, all;

    explicit SlopesSeen(const T &to) : v(to) {
        using std::erfc;
        all = v + (AllSlopes::density(v) - v * erfc(v)) / T(2.0);
    }
    T share_below(const T &t) const { return (v * AllSlopes::share_below(t) + AllSlopes::density(t) / T(2.0)) / all; }
    T density(const T &t) const { return (v - t) * AllSlopes::density(t) / all; }
};

template <class T, class Slopes>
T newton(const Slopes &slopes, T t, const T &u, int steps) {
    for (int step = 0; step < steps; ++step) t = t + (u - slopes.share_below(t)) / slopes.density(t);
    return t;
}

// Slope in low..high that has the share u below it, to a double's rounding.
template <class Slopes>
double root(const Slopes &slopes, double u, double low, double high) {
    for (int step = 0; step < 25; ++step) {
        const double t = 0.5 * (low + high);
        (slopes.share_below(t) < u ? low : high) = t;
    }
    double t = 0.5 * (low + high);
    for (int step = 0; step < 4; ++step) t = std::clamp(newton(slopes, t, u, 1), low, high);
    return t;
}

// The same in T: one step of what already has a double's digits doubles them.
constexpr int steps_from_double = 3;

// u from 2^-70 to 1 - 2^-24.
template <class T>
T gaussian_slope(const T &u, double u_value) {
    return newton(AllSlopes(), T(root(AllSlopes(), u_value, -8.0, 5.0)), u, steps_from_double);
}

// u from 2^-25 to 1 - 2^-24.
template <class T>
T visible_slope(const T &v, double v_value, const T &u, double u_value) {
    const double start = root(SlopesSeen<double>(v_value), u_value, -5.0, std::min(v_value, 5.0));
    return newton(SlopesSeen<T>(v), T(start), u, steps_from_double);
}

// Normal of the facet with these slopes along the direction to the viewer wo and across it, in standard deviations
// times sqrt(2). With S twice the covariance and w = (wo.x, wo.y), s^2 = w'Sw, they are S w / s and sqrt(det S) J w /
// s, J the turn by a right angle: the symmetric root of S, applied to w / |root w| and its turn. s > 0.
template <class T>
VecOf<T> facet_along_view(const GaussianOf<T> &g, const VecOf<T> &wo, const T &along, const T &across) {
    using std::sqrt;
    const T s = sqrt(spread2(g, wo)), a = T(2.0) * along / s, b = T(2.0) * sqrt(determinant(g)) * across / s;
    const T x = g.mean_x + a * (g.cov_xx * wo.x + g.cov_xy * wo.y) - b * wo.y;
    const T y = g.mean_y + a * (g.cov_xy * wo.x + g.cov_yy * wo.y) + b * wo.x;
    const T inv_z = sqrt(T(1.0) + x * x + y * y);
    return {T(0.0) - x / inv_z, T(0.0) - y / inv_z, T(1.0) / inv_z};
}

// wo mirrored about a facet.
template <class T>
VecOf<T> mirrored_about(const VecOf<T> &wo, const VecOf<T> &m) {
    const T twice = T(2.0) * (wo.x * m.x + wo.y * m.y + wo.z * m.z);
    return {twice * m.x - wo.x, twice * m.y - wo.y, twice * m.z - wo.z};
}

} // namespace oracle
