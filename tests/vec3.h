// Vectors of the oracle, in double. Directions point away from the surface.
#pragma once

#include <cmath>

namespace oracle {

inline constexpr double pi = 3.14159265358979323846;

struct Vec {
    double x = 0.0, y = 0.0, z = 0.0;
};

inline Vec operator+(const Vec &a, const Vec &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec &a, const Vec &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec &a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec &a, const Vec &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec &a, const Vec &b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec &a) { return std::sqrt(dot(a, a)); }
inline Vec normalised(const Vec &a) { return (1.0 / length(a)) * a; }

// The angle between two directions, precise near 0 and near pi.
inline double angle(const Vec &a, const Vec &b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

inline Vec half_vector(const Vec &wi, const Vec &wo) { return normalised(wi + wo); }

inline Vec spherical(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

inline Vec reflect(const Vec &w, const Vec &about) { return 2.0 * dot(w, about) * about - w; }

} // namespace oracle
