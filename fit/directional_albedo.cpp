#include "directional_albedo.h"

#include <algorithm>
#include <cmath>

#include "lobe_value.h"
#include "material_value.h"

namespace smx {

using std::numbers::pi;

namespace {

constexpr std::size_t azimuths = 18; // over half a turn; the other half mirrors them

// f at a theta_h node: linear in theta_d, the nearest phi_d, mean of phi_d and its mirror image.
Rgb table_value(const Brdf &brdf, std::size_t h, double theta_d, double phi_d) {
    const double row = theta_d * 180 / pi;
    const auto below = std::min(static_cast<std::size_t>(row), Brdf::theta_d_count - 1);
    const std::size_t above = std::min(below + 1, Brdf::theta_d_count - 1), columns = brdf.phi_d_count();
    const auto column = static_cast<std::size_t>(std::lround(phi_d * 180 / pi));
    Rgb f{};
    for (std::size_t p : {column % columns, (360 - column) % columns})
        for (std::size_t c = 0; c < 3; ++c)
            f[c] += std::lerp(brdf.value(c, brdf.cell(h, below, p)), brdf.value(c, brdf.cell(h, above, p)),
                              row - static_cast<double>(below)) /
                    2;
    return f;
}

} // namespace

DirectionalAlbedo::DirectionalAlbedo(const Brdf &brdf) {
    for (double degrees : theta_o_degrees) {
        const Eigen::Vector3d wo(std::sin(degrees * pi / 180), 0.0, std::cos(degrees * pi / 180));
        std::vector<Node> &nodes = nodes_.emplace_back();
        for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
            for (std::size_t a = 0; a < azimuths; ++a) {
                const double theta_h = Brdf::theta_h(h), phi = (static_cast<double>(a) + 0.5) / azimuths * pi;
                const Eigen::Vector3d wh(std::sin(theta_h) * std::cos(phi), std::sin(theta_h) * std::sin(phi),
                                         std::cos(theta_h));
                const double cos_d = wo.dot(wh), cos_i = 2 * cos_d * wh.z() - wo.z();
                if (cos_d <= 0.0 || cos_i <= 0.0) continue;
                // phi_d from the cosine rule cos_i = cos_h cos_d - sin_h sin_d cos(phi_d); any where a sine is 0.
                const double theta_d = std::acos(std::min(cos_d, 1.0)), sines = std::sin(theta_h) * std::sin(theta_d);
                const double cosine = sines > 0.0 ? (wh.z() * cos_d - cos_i) / sines : 1.0;
                const double phi_d = std::acos(std::clamp(cosine, -1.0, 1.0)); // beyond by roundings
                DirectionSample s = direction_at(theta_h, theta_d, phi_d);
                s.f = table_value(brdf, h, theta_d, phi_d);
                s.weight = cos_i * 4 * cos_d * Brdf::theta_h_weight(h) * 2 * pi / azimuths;
                nodes.push_back({s, theta_d});
            }
    }
}

std::vector<Rgb> DirectionalAlbedo::of_table() const {
    std::vector<Rgb> albedo;
    for (const std::vector<Node> &nodes : nodes_) {
        albedo.push_back({});
        for (const Node &node : nodes)
            for (std::size_t c = 0; c < 3; ++c) albedo.back()[c] += node.sample.weight * node.sample.f[c];
    }
    return albedo;
}

std::vector<Rgb> DirectionalAlbedo::of(const Material &material) const {
    std::vector<Rgb> albedo;
    for (const std::vector<Node> &nodes : nodes_) {
        albedo.push_back({});
        for (const Node &node : nodes) {
            const Rgb f = MaterialAtLevel(material, node.theta_d, 0.0)(node.sample);
            for (std::size_t c = 0; c < 3; ++c) albedo.back()[c] += node.sample.weight * f[c];
        }
    }
    return albedo;
}

std::vector<Rgb> DirectionalAlbedo::bound() const {
    std::vector<Rgb> bound = of_table();
    for (Rgb &albedo : bound)
        for (double &channel : albedo) channel = std::max(channel, 1.0);
    return bound;
}

std::vector<Eigen::MatrixXd> DirectionalAlbedo::shares(const std::vector<double> &alphas) const {
    const auto lobes = static_cast<Eigen::Index>(alphas.size());
    std::vector<Eigen::MatrixXd> all;
    for (const std::vector<Node> &nodes : nodes_) {
        all.push_back(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(curve_coefficients), lobes));
        for (const Node &node : nodes) {
            const auto [first, weight] = curve_shares(node.theta_d);
            for (Eigen::Index k = 0; k < lobes; ++k) {
                const double lobe = lobe_value(node.sample, alphas[static_cast<std::size_t>(k)]).value;
                for (std::size_t a = 0; a < 3; ++a)
                    all.back()(static_cast<Eigen::Index>(first + a), k) += weight[a] * node.sample.weight * lobe;
            }
        }
    }
    return all;
}

} // namespace smx
