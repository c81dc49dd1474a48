// What must hold of any microsurface, of D and sigma as cl/mixture.clh computes them, on surfaces and lobes from 1e-4
// to 1e3 and directions down to grazing: D cos integrates to 1, so do visible normals, sigma is linear in the weights,
// and shading is D and the masking that sigma makes.
#include <gtest/gtest.h>

#include <array>

#include "close.h"
#include "context.h"
#include "device_buffer.h"
#include "device_lobe.h"
#include "random.h"
#include "scene.h"
#include "slope_grid.h"
#include "support.h"

using oracle::Mixture;
using oracle::Vec;

namespace {

// Points per lobe and axis, and what a kink leaves of midpoints' error: a twelfth of the squared step, 10 / grid.
constexpr int grid = 320;
constexpr double integral_tolerance = 1e-4;
// Roundings of floats: sums of a few lobes; values of f, whose exponents are up to 10.
constexpr double sum_tolerance = 2e-6, value_tolerance = 2e-5;

struct Surface {
    smx_displacement x;
    std::vector<oracle::Lobe> lobes;
    Mixture mixture() const { return {lobes, test::gaussian(x)}; }
};

std::vector<Surface> surfaces() {
    std::vector<Surface> list{
        {{0.0, 0.0, 0.0, 0.0, 0.0}, {{1.0, 1e-4}}},
        {{0.0, 0.0, 0.0, 0.0, 0.0}, {{0.3, 1e-4}, {0.7, 1e3}}},
        {{1e3, 0.1, 0.0, 0.0, 0.0}, {{1.0, 1e-3}}},
        {{0.0, 1.0, 0.0, 0.0, 0.0}, {{0.5, 1e-4}, {0.5, 0.1}}},
        {{0.5, 0.5, 1.0 - 1e-6, 0.0, 0.0}, {{1.0, 1e-3}}},
        {{0.3, 0.2, -0.7, 0.4, -0.3}, {{1.0 - 1e-12, 0.1}, {1e-12, 1.0}}},
        {{1e3, 1e3, 0.9, 3.0, -2.0}, {{1.0, 0.1}}},
    };
    test::Random random(41);
    for (int k = 0; k < 8; ++k) {
        const double rho = 1.0 - random.log_uniform(1e-4, 1.0), share = random.uniform(0.05, 0.95);
        list.push_back({{random.log_uniform(1e-3, 10.0), random.log_uniform(1e-3, 10.0), k % 2 ? rho : -rho,
                         random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)},
                        {{share, random.log_uniform(1e-3, 1.0)}, {1.0 - share, random.log_uniform(1e-2, 10.0)}}});
    }
    return list;
}

// Down to grazing, and straight along the axes.
std::vector<Vec> directions() {
    test::Random random(43);
    std::vector<Vec> list{{0.0, 0.0, 1.0}};
    for (const double elevation : {1.0, 0.1, 1e-3, 1e-4, 1e-7})
        for (int k = 0; k < 3; ++k) {
            const double phi = k < 2 ? k * oracle::pi / 2.0 : random.uniform(0.0, 2.0 * oracle::pi);
            list.push_back(
                {std::cos(elevation) * std::cos(phi), std::cos(elevation) * std::sin(phi), std::sin(elevation)});
        }
    return list;
}

smx::Context &device() {
    static smx::Context c("", 0);
    return c;
}

smx::Material material_of(const Surface &s) {
    smx::Material material;
    material.model = smx::Model::Shared;
    for (const oracle::Lobe &l : s.lobes) material.lobes.push_back({l.weight, l.alpha});
    return material;
}

// D of normals and sigma towards directions, [count] each.
struct Values {
    std::vector<float> d, sigma;
};

Values evaluate(const Surface &s, const std::vector<Vec> &at) {
    static const cl::Program program = [] {
        const std::string source = smx::kernel_source("mixture.clh") + R"(
__kernel void probe(__global float *d, __global float *sigma, int stride, __global const float *k, Displacement x,
                    __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    realW kx = load_floatsW(0, k + at), ky = load_floatsW(0, k + stride + at), kz = load_floatsW(0, k + 2 * stride + at);
    Tilted h = tilted(&x, kx, ky, kz);
    Slanted w = slanted(&x, kx, ky, mean_plane(&x, kx, ky, kz));
    store_floatsW(mixture_ndf(lobes, count, &h), 0, d + at);
    store_floatsW(mixture_sigma(lobes, count, &w), 0, sigma + at);
})";
        cl::Program made(device().cl(), source);
        made.build(smx::build_options({{"W", static_cast<int>(device().width())}}).c_str());
        return made;
    }();
    const std::size_t stride = smx::round_up(at.size(), device().width());
    std::vector<float> planes(3 * stride, 1.0f);
    for (std::size_t k = 0; k < at.size(); ++k) {
        planes[k] = static_cast<float>(at[k].x);
        planes[stride + k] = static_cast<float>(at[k].y);
        planes[2 * stride + k] = static_cast<float>(at[k].z);
    }
    const smx::Displacement x{s.x.alpha_x, s.x.alpha_y, s.x.rho, s.x.mean_slope_x, s.x.mean_slope_y};
    const cl::Buffer lobes = smx::buffer_from(device(), smx::widened_lobes<float>(material_of(s), x)),
                     in = smx::buffer_from(device(), planes);
    const cl::Buffer d = smx::empty_buffer<float>(device(), stride), sigma = smx::empty_buffer<float>(device(), stride);
    cl::Kernel kernel(program, "probe");
    kernel.setArg(0, d);
    kernel.setArg(1, sigma);
    kernel.setArg(2, static_cast<cl_int>(stride));
    kernel.setArg(3, in);
    kernel.setArg(4, smx::to_device(x));
    kernel.setArg(5, lobes);
    kernel.setArg(6, static_cast<cl_int>(s.lobes.size()));
    device().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(stride / device().width()));
    Values values{std::vector<float>(stride), std::vector<float>(stride)};
    device().queue().enqueueReadBuffer(d, CL_TRUE, 0, stride * sizeof(float), values.d.data());
    device().queue().enqueueReadBuffer(sigma, CL_TRUE, 0, stride * sizeof(float), values.sigma.data());
    return values;
}

std::string name(const Surface &s) {
    return "X " + std::to_string(s.x.alpha_x) + " " + std::to_string(s.x.alpha_y) + " rho " + std::to_string(s.x.rho) +
           ", first alpha " + std::to_string(s.lobes[0].alpha);
}

// The slope density at the grid's points, from D.
std::vector<double> p22_of(const Surface &s, const std::vector<test::SlopePoint> &points) {
    std::vector<Vec> normals;
    for (const test::SlopePoint &p : points) normals.push_back(oracle::normalised({-p.x, -p.y, 1.0}));
    const Values values = evaluate(s, normals);
    std::vector<double> p22;
    for (std::size_t k = 0; k < points.size(); ++k) p22.push_back(values.d[k] * std::pow(normals[k].z, 4));
    return p22;
}

Vec as_floats(const Vec &w) { return {static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)}; }

} // namespace

TEST(Identities, NormalsIntegrateToOne) {
    for (const Surface &s : surfaces()) {
        const std::vector<test::SlopePoint> points = test::slope_grid(s.mixture(), grid);
        const std::vector<double> p22 = p22_of(s, points);
        double sum = 0.0;
        for (std::size_t k = 0; k < points.size(); ++k) sum += points[k].weight * p22[k];
        EXPECT_CLOSE(sum, 1.0, integral_tolerance, 0.0) << name(s);
    }
}

// <w,m>+ D(m) / sigma(w): D and sigma know of each other.
TEST(Identities, VisibleNormalsIntegrateToOne) {
    for (const Surface &s : surfaces()) {
        const std::vector<test::SlopePoint> points = test::slope_grid(s.mixture(), grid);
        const std::vector<double> p22 = p22_of(s, points);
        const oracle::Gaussian x = test::gaussian(s.x);
        const std::vector<Vec> all = directions();
        const Values values = evaluate(s, all);
        int seen = 0;
        for (std::size_t j = 0; j < all.size(); ++j) {
            const Vec w = as_floats(all[j]);
            if (oracle::plane(x, w) <= 0.0) continue;
            double sum = 0.0;
            for (std::size_t k = 0; k < points.size(); ++k)
                sum += points[k].weight * p22[k] * std::max(0.0, w.z - w.x * points[k].x - w.y * points[k].y);
            EXPECT_CLOSE(sum / values.sigma[j], 1.0, integral_tolerance, 0.0)
                << name(s) << ", w " << w.x << " " << w.y << " " << w.z;
            ++seen;
        }
        EXPECT_GT(seen, 5);
    }
}

TEST(Identities, ProjectedAreaIsLinearInTheWeights) {
    for (const Surface &s : surfaces()) {
        const std::vector<Vec> all = directions();
        const Values values = evaluate(s, all);
        std::vector<double> sum(all.size());
        for (const oracle::Lobe &lobe : s.lobes) {
            const Values one = evaluate({s.x, {{1.0, lobe.alpha}}}, all);
            for (std::size_t j = 0; j < all.size(); ++j) sum[j] += lobe.weight * one.sigma[j];
        }
        for (std::size_t j = 0; j < all.size(); ++j)
            if (oracle::plane(test::gaussian(s.x), all[j]) > 0.0) {
                EXPECT_CLOSE(values.sigma[j], sum[j], sum_tolerance, 0.0) << name(s) << ", direction " << j;
            }
    }
}

// f cos = D G2 / (4 p_o), with G1 = p / sigma, for both kinds of masking: the C API's shading against the pieces.
TEST(Identities, ShadingIsTheDensityAndItsOwnMasking) {
    for (const Surface &s : surfaces())
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
            std::vector<Vec> wi, wo, wh;
            std::vector<float> wi_floats, wo_floats;
            const std::vector<Vec> all = directions();
            for (const Vec &i : all)
                for (const Vec &o : all) {
                    wi.push_back(as_floats(i)), wo.push_back(as_floats(o));
                    wh.push_back(wi.back() + wo.back());
                    for (const double v : {i.x, i.y, i.z}) wi_floats.push_back(static_cast<float>(v));
                    for (const double v : {o.x, o.y, o.z}) wo_floats.push_back(static_cast<float>(v));
                }
            std::vector<float> fcos(3 * wi.size());
            ASSERT_SMX_OK(smx_material_eval(test::context(), test::make_material(s.lobes), &s.x, g, nullptr, wi.size(),
                                            wi_floats.data(), wo_floats.data(), fcos.data()));
            const Values at_i = evaluate(s, wi), at_o = evaluate(s, wo), at_h = evaluate(s, wh);
            const oracle::Gaussian x = test::gaussian(s.x);
            for (std::size_t k = 0; k < wi.size(); ++k) {
                const double p_i = oracle::plane(x, wi[k]), p_o = oracle::plane(x, wo[k]);
                if (p_i < 1e-6 || p_o < 1e-6) continue; // of floats, a plane this low has no digits left
                const double g2 = oracle::g2(test::masking(g), p_i, at_i.sigma[k], p_o, at_o.sigma[k]);
                EXPECT_CLOSE(fcos[3 * k], at_h.d[k] * g2 / (4.0 * p_o), value_tolerance, 1e-30)
                    << name(s) << ", pair " << k;
            }
        }
}
