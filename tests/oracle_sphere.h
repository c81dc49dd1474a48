// The scene of the oracle: a unit sphere that fills the smaller side of the image, an orthographic camera on +y that
// looks along -y, right = +x, up = +z, and a directional light in the plane z = 0.
#pragma once

#include <algorithm>

#include "vec3.h"

namespace oracle {

struct Pixel {
    bool on_sphere = false;
    double edge_distance = 0.0; // of the pixel's centre from the silhouette, in radii; negative outside
    Vec wi, wo;                 // in the local frame x = e_theta, y = e_phi, z = normal
};

inline Pixel sphere_pixel(int width, int height, double column, double row, double light_phi) {
    const double radius = std::min(width, height) / 2.0;
    const double x = (column + 0.5 - width / 2.0) / radius, z = (height / 2.0 - row - 0.5) / radius;
    Pixel p;
    p.edge_distance = 1.0 - std::hypot(x, z);
    p.on_sphere = p.edge_distance > 0.0;
    if (!p.on_sphere) return p;
    const Vec n{x, std::sqrt(1.0 - x * x - z * z), z};
    const double theta = std::atan2(std::hypot(n.x, n.y), n.z), phi = std::atan2(n.y, n.x);
    const Vec e_theta{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)};
    const Vec e_phi{-std::sin(phi), std::cos(phi), 0.0};
    const Vec camera{0.0, 1.0, 0.0}, light{std::cos(light_phi), std::sin(light_phi), 0.0};
    p.wo = {dot(camera, e_theta), dot(camera, e_phi), dot(camera, n)};
    p.wi = {dot(light, e_theta), dot(light, e_phi), dot(light, n)};
    return p;
}

} // namespace oracle
