#include "widening.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "device_buffer.h"
#include "error.h"

namespace smx {

namespace {

// The model of the integrand that places an order's nodes (cl/facet_peak.clh), how far the first guess keeps from a
// horizon, and how much X counts in it against the lobe. Chosen on 70 measured materials at alphas 0.25 and 0.5 for the
// least error of each order (docs/widening.md). Order 1 takes the integrand's own exponents, but for more of the
// masking; the more nodes there are, the less it matters.
struct Placement {
    double turn_h, turn_z, masked;
    double lift, pull;
    int steps; // to other charts
};

Placement placement(int order) {
    switch (order) {
        case 1:
            return {4.0, 4.0, 1.85, 1.65, 1.8, 0};
        case 2:
            return {3.0, 1.0, 0.9, 0.9, 1.0, 1};
        case 3:
            return {4.75, 2.0, 0.8, 1.0, 4.0, 0};
        case 4:
            return {3.0, 3.0, 1.1, 0.9, 1.0, 1};
        case 5:
            return {3.0, 3.0, 1.0, 0.9, 1.0, 1};
        default:
            return {3.0, 1.0, 0.8, 0.9, 1.0, 1};
    }
}

// How fast the model's sigma falls to the cosine.
constexpr double fall_over_sigma = 0.2;

// Principal axes, the rougher one first.
PrincipalAxes rougher_first(const Displacement &displacement) {
    const PrincipalAxes axes = rough_principal_axes(displacement);
    if (axes.var_1 >= axes.var_2) return axes;
    return {-axes.axis_y, axes.axis_x, axes.var_2, axes.var_1};
}

// alpha / (2 sqrt(pi)): of the lobe, or of the mixture that masks all of them.
double grazing_sigma(const Material &material, double alpha) {
    if (material.model == Model::Shared) {
        alpha = 0.0;
        for (const Lobe &lobe : material.lobes) alpha += lobe.weight * lobe.alpha;
    }
    return alpha / (2.0 * std::sqrt(std::numbers::pi));
}

// Nodes of the orders below: 1 + 2 + ... + (order - 1).
int first_node(int order) { return order * (order - 1) / 2; }

double reciprocal_or_0(double x) { return x > 0.0 ? 1.0 / x : 0.0; }

// As in cl/facet_chart.clh, cl/facet_peak.clh and cl/widen.clh.
template <typename Real>
struct DeviceFacets {
    Real axis_x, axis_y, mean_1, mean_2, alpha_1, alpha_2, inv_alpha_1, inv_alpha_2, n_x, n_y, n_z, flatness;
};

template <typename Real>
struct DeviceQuadratureLobe {
    std::int32_t order, nodes, steps;
    Real alpha2, inv_alpha2, peak;
    Real half_turn_h, half_turn_z, half_masked;
    Real sigma_0, fall;
    Real towards_mean_1, towards_mean_2, reach2;
};

template <typename Real>
struct DeviceNode {
    Real z, weight;
};

template <typename Real>
DeviceFacets<Real> device_facets(const Displacement &x) {
    const PrincipalAxes axes = rougher_first(x);
    const double mean_1 = axes.axis_x * x.mean_slope_x + axes.axis_y * x.mean_slope_y;
    const double mean_2 = axes.axis_x * x.mean_slope_y - axes.axis_y * x.mean_slope_x;
    const double alpha_1 = std::sqrt(axes.var_1), alpha_2 = std::sqrt(axes.var_2);
    const double n_z = 1.0 / std::sqrt(1.0 + mean_1 * mean_1 + mean_2 * mean_2);
    const auto r = [](double v) { return static_cast<Real>(v); };
    return {r(axes.axis_x),
            r(axes.axis_y),
            r(mean_1),
            r(mean_2),
            r(alpha_1),
            r(alpha_2),
            r(reciprocal_or_0(alpha_1)),
            r(reciprocal_or_0(alpha_2)),
            r(-mean_1 * n_z),
            r(-mean_2 * n_z),
            r(n_z),
            r(axes.var_2 / axes.var_1)};
}

// One entry per order, of the material's lobes in turn.
template <typename Real>
std::vector<DeviceQuadratureLobe<Real>> quadrature_lobes(const Material &material, const std::vector<int> &orders,
                                                         const Displacement &displacement) {
    const PrincipalAxes axes = rougher_first(displacement);
    const double pi = std::numbers::pi;
    // Norms of X's density in f: exp(-f^2) / sqrt(pi) by axis; cl/widen.clh has f's derivatives, which on a line hold
    // 1 / alpha_1.
    const double surface =
        axes.var_2 > 0.0 ? 1.0 / (pi * std::sqrt(axes.var_1) * std::sqrt(axes.var_2)) : 1.0 / std::sqrt(pi);
    const auto r = [](double v) { return static_cast<Real>(v); };
    std::vector<DeviceQuadratureLobe<Real>> lobes;
    for (std::size_t entry = 0; entry < orders.size(); ++entry) {
        const auto &[share, alpha] = material.lobes[entry % material.lobes.size()];
        const double alpha2 = alpha * alpha, sigma_0 = grazing_sigma(material, alpha);
        const double weight = material.model == Model::Shared ? share : 1.0;
        const int order = orders[entry];
        const Placement model = placement(order);
        const double pull_1 = model.pull * axes.var_1, pull_2 = model.pull * axes.var_2;
        lobes.push_back({order, first_node(order), model.steps, r(alpha2), r(1.0 / alpha2),
                         r(weight / (pi * alpha2) * surface), r(model.turn_h / 2), r(model.turn_z / 2),
                         r(model.masked / 2), r(sigma_0), r(fall_over_sigma / sigma_0), r(alpha2 / (alpha2 + pull_1)),
                         r(alpha2 / (alpha2 + pull_2)),
                         r(2.0 * model.lift * alpha2 * axes.var_1 / (alpha2 + axes.var_1))});
    }
    return lobes;
}

// Golub and Welsch 1969: nodes are the eigenvalues of the recurrence's matrix, weights the squares of the eigenvectors'
// first components times the integral of exp(-z^2). The orders follow one another, as first_node has them.
template <typename Real>
std::vector<DeviceNode<Real>> hermite_nodes() {
    std::vector<DeviceNode<Real>> nodes;
    for (int order = 1; order <= max_widening_order; ++order) {
        Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(order), beside(order - 1);
        for (int j = 1; j < order; ++j) beside[j - 1] = std::sqrt(j / 2.0);
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
        solver.computeFromTridiagonal(diagonal, beside);
        for (int j = 0; j < order; ++j) {
            const double z = solver.eigenvalues()[j], first = solver.eigenvectors()(0, j);
            const double weight = std::sqrt(std::numbers::pi) * first * first;
            nodes.push_back({static_cast<Real>(z), static_cast<Real>(weight * std::exp(z * z))});
        }
    }
    return nodes;
}

} // namespace

int rough_axes(const Displacement &displacement) {
    const PrincipalAxes axes = rough_principal_axes(displacement);
    return (axes.var_1 > 0.0) + (axes.var_2 > 0.0);
}

std::vector<int> fixed_orders(const Material &material, const Displacement &displacement, int order) {
    return std::vector<int>(material.lobes.size(), rough_axes(displacement) == 0 ? 0 : order);
}

void validate_widening(const RenderOptions &o) {
    require(o.widening_order >= widening_auto && o.widening_order <= max_widening_order, "widening_order is ",
            o.widening_order, "; it must be 0..", max_widening_order, ", or -1 (auto)");
    require(o.widening_tolerance > 0.0 && o.widening_tolerance < 1.0, "widening_tolerance is ", o.widening_tolerance,
            "; it must be above 0 and below 1");
}

std::vector<cl::Buffer> set_widening(const Context &context, cl::Kernel &kernel, cl_uint first,
                                     const Material &material, const Displacement &displacement,
                                     const std::vector<int> &orders, Grade grade) {
    return with_real(grade, [&](auto real) {
        using Real = decltype(real);
        static const std::vector<DeviceNode<Real>> nodes = hermite_nodes<Real>();
        kernel.setArg(first, device_facets<Real>(displacement));
        std::vector<cl::Buffer> buffers = {buffer_from(context, quadrature_lobes<Real>(material, orders, displacement)),
                                           buffer_from(context, nodes)};
        kernel.setArg(first + 1, buffers[0]);
        kernel.setArg(first + 2, buffers[1]);
        return buffers;
    });
}

} // namespace smx
