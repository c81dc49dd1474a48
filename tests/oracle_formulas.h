// The formulas of the notation page, once, for any arithmetic T: long double for the bulk, test::Big where 60 digits
// are asked for, test::Dual for condition numbers. Written apart from cl/ and lib/, in slopes' covariances, where the
// device has principal axes. T has + - * / <, exp, sqrt, erfc and a constructor from double.
//   Walter et al. 2007; Smith 1967; Dupuy 2015.
#pragma once

#include <cmath>

namespace oracle {

template <class T>
T pi_of() {
    return T(3.14159265358979323846);
}
template <>
inline long double pi_of() {
    return 3.14159265358979323846264338327950288L;
}

template <class T>
struct VecOf {
    T x, y, z;
};

template <class T>
VecOf<T> operator+(const VecOf<T> &a, const VecOf<T> &b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T>
VecOf<T> operator-(const VecOf<T> &a, const VecOf<T> &b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

// A Gaussian density of slopes: mean and covariance. Covariances of 0 are legal and mean "all mass on a line or point".
template <class T>
struct GaussianOf {
    T mean_x{}, mean_y{};
    T cov_xx{}, cov_xy{}, cov_yy{};
};

// From roughnesses: alpha is sqrt(2) times the standard deviation of the slope.
template <class T>
GaussianOf<T> gaussian_of(const T &alpha_x, const T &alpha_y, const T &rho, const T &mean_x, const T &mean_y) {
    return {mean_x, mean_y, alpha_x * alpha_x / T(2.0), rho * alpha_x * alpha_y / T(2.0), alpha_y * alpha_y / T(2.0)};
}

// `x` widened by an isotropic lobe of zero mean: covariances add.
template <class T>
GaussianOf<T> widened_by(GaussianOf<T> x, const T &alpha) {
    x.cov_xx = x.cov_xx + alpha * alpha / T(2.0);
    x.cov_yy = x.cov_yy + alpha * alpha / T(2.0);
    return x;
}

template <class T>
T determinant(const GaussianOf<T> &g) {
    return g.cov_xx * g.cov_yy - g.cov_xy * g.cov_xy;
}

// The exponent of p22 without its sign: half the squared Mahalanobis distance.
template <class T>
T exponent(const GaussianOf<T> &g, const T &slope_x, const T &slope_y) {
    const T x = slope_x - g.mean_x, y = slope_y - g.mean_y;
    return (g.cov_yy * x * x - T(2.0) * g.cov_xy * x * y + g.cov_xx * y * y) / (T(2.0) * determinant(g));
}

// Density over the slope plane, 1 over its integral. Needs a covariance of full rank.
template <class T>
T p22(const GaussianOf<T> &g, const T &slope_x, const T &slope_y) {
    using std::exp, std::sqrt;
    return exp(T(0.0) - exponent(g, slope_x, slope_y)) / (T(2.0) * pi_of<T>() * sqrt(determinant(g)));
}

// Distribution of normals, integral of ndf(m) m.z dm = 1 for a zero mean. m need not be normalised; 0 where it does not
// point up.
template <class T>
T ndf(const GaussianOf<T> &g, const VecOf<T> &m) {
    if (!(T(0.0) < m.z)) return T(0.0);
    const T x = T(0.0) - m.x / m.z, y = T(0.0) - m.y / m.z, inv_cos2 = T(1.0) + x * x + y * y;
    return p22(g, x, y) * inv_cos2 * inv_cos2;
}

// Projected area of the mean plane towards k: cos(theta_k) when the mean slope is 0.
template <class T>
T plane(const GaussianOf<T> &g, const VecOf<T> &k) {
    return k.z - k.x * g.mean_x - k.y * g.mean_y;
}

// s^2 = 2 k_t' Cov k_t.
template <class T>
T spread2(const GaussianOf<T> &g, const VecOf<T> &k) {
    return T(2.0) * (g.cov_xx * k.x * k.x + T(2.0) * g.cov_xy * k.x * k.y + g.cov_yy * k.y * k.y);
}

// Projected area of the surface towards k: E max(0, k.z - k.x x - k.y y) over its slopes. 1 + erf(v) is written
// erfc(-v), which does not cancel; with p > 0 both terms are positive.
template <class T>
T sigma(const GaussianOf<T> &g, const VecOf<T> &k) {
    using std::erfc, std::exp, std::sqrt;
    const T p = plane(g, k), s2 = spread2(g, k);
    if (!(T(0.0) < s2)) return p < T(0.0) ? T(0.0) : p;
    const T s = sqrt(s2), v = p / s;
    return p * erfc(T(0.0) - v) / T(2.0) + s * exp(T(0.0) - v * v) / (T(2.0) * sqrt(pi_of<T>()));
}

// sigma - p, for p >= 0.
template <class T>
T beyond_plane(const GaussianOf<T> &g, const VecOf<T> &k) {
    using std::erfc, std::exp, std::sqrt;
    const T p = plane(g, k), s2 = spread2(g, k);
    if (!(T(0.0) < s2)) return T(0.0);
    const T s = sqrt(s2), v = p / s;
    return (s * exp(T(0.0) - v * v) / sqrt(pi_of<T>()) - p * erfc(v)) / T(2.0);
}

// Masking and shadowing from the plane's and the surface's projected areas, p > 0.
template <class T>
T g2_separable(const T &p_i, const T &sigma_i, const T &p_o, const T &sigma_o) {
    return (p_i / sigma_i) * (p_o / sigma_o);
}

template <class T>
T g2_correlated(const T &p_i, const T &sigma_i, const T &p_o, const T &sigma_o) {
    return p_i * p_o / (sigma_i * p_o + sigma_o * p_i - p_i * p_o);
}

// theta_d over pi/2: the angle between wi and wh, from their difference and their sum.
template <class T>
T difference_angle(const VecOf<T> &wi, const VecOf<T> &wo) {
    using std::atan2, std::sqrt;
    const VecOf<T> d = wi - wo, h = wi + wo;
    const T chord = sqrt(d.x * d.x + d.y * d.y + d.z * d.z), sum = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    return T(2.0) * atan2(chord, sum) / pi_of<T>();
}

} // namespace oracle
