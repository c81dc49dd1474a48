// Directions that estimates under all light are drawn by, cl/draw_light.clh and cl/bounce.clh, against their density.
// One of the uniform numbers chooses a part, the cosine or a lobe: of each part the directions are counted in cells
// (chi-square; Bonferroni's correction), and what is returned beside them is the density of all parts together.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cstdio>

#include "close.h"
#include "context.h"
#include "device_buffer.h"
#include "light_lobes.h"
#include "oracle.h"
#include "random.h"
#include "sampling_parts.h"
#include "scene.h"

namespace {

using oracle::Vec;
using Lobes = std::vector<smx::Lobe>;

// One run of this file in a thousand refuses what is right.
constexpr double significance = 1e-3;
constexpr int number_of_tests = 200; // at least as many as p-values are asked for below
constexpr std::size_t side = 16, drawn = 1 << 17;
// Of the draws, what the cosine has (COSINE_SHARE).
constexpr double cosine_share = 0.25;
// Float roundings times what their condition makes of them (16 eps (1 + cond)).
constexpr double roundings = 16 * 0x1p-24;

smx::Context &device() {
    static smx::Context c("", 0);
    return c;
}

// What is drawn from: a mixture that X widens, seen from wo; or, about a facet, one that nothing does.
struct Setting {
    Lobes lobes;
    smx::Displacement x;
    Vec wo;
    bool about_facet = false;
    Vec wm{0.0, 0.0, 1.0};

    // Of lobe k: of the mixture's draws.
    double share(std::size_t k) const {
        double total = 0.0;
        for (const smx::Lobe &lobe : lobes) total += lobe.weight;
        const double weight = lobes[k].weight / total;
        return about_facet ? weight : 0.5 * weight + 0.5 / static_cast<double>(lobes.size());
    }
    std::string name() const {
        return (about_facet ? "about a facet, first alpha " : "first alpha ") + std::to_string(lobes[0].alpha) +
               ", X " + std::to_string(x.alpha_x) + " " + std::to_string(x.alpha_y) + " rho " + std::to_string(x.rho) +
               ", wo.z " + std::to_string(oracle::dot(wo, wm));
    }
};

struct Draw {
    Vec wi;
    double density;
};

// Numbers as the kernels take them: one that chooses, one for the radius, and about a facet one for the azimuth.
using Three = std::array<float, 3>;

const cl::Program &probes() {
    static const cl::Program program = [] {
        const std::string source = smx::kernel_source("draw_light.clh") + R"(
inline float4 result(Bounce b) { return (float4)(b.wi.x, b.wi.y, b.wi.z, b.density); }
__kernel void light(__global float4 *out, __global const float *u, Displacement x, __constant LightLobe *lobes,
                    int count, float4 wo) {
    size_t at = get_global_id(0);
    PlaneW numbers = {u[3 * at], u[3 * at + 1]};
    VectorW o = {wo.x, wo.y, wo.z};
    out[at] = result(draw_light(&x, lobes, count, numbers, o));
}
__kernel void bounce(__global float4 *out, __global const float *u, __constant float2 *lobes, int count, float4 wo,
                     float4 wm) {
    size_t at = get_global_id(0);
    UniformsW numbers = {u[3 * at], u[3 * at + 1], u[3 * at + 2]};
    VectorW o = {wo.x, wo.y, wo.z}, m = {wm.x, wm.y, wm.z};
    out[at] = result(draw_bounce(numbers, o, m, lobes, count));
})";
        cl::Program made(device().cl(), source);
        made.build();
        return made;
    }();
    return program;
}

cl_float4 to_float4(const Vec &v) {
    return {{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f}};
}

std::vector<Draw> draw(const Setting &s, const std::vector<Three> &u) {
    cl::Kernel kernel(probes(), s.about_facet ? "bounce" : "light");
    const cl::Buffer out = smx::empty_buffer<cl_float4>(device(), u.size()), in = smx::buffer_from(device(), u);
    smx::Material material;
    material.lobes = s.lobes;
    const cl::Buffer lobes = s.about_facet ? smx::buffer_from(device(), smx::cumulated(s.lobes))
                                           : smx::buffer_from(device(), smx::light_lobes<float>(material, s.x));
    cl_uint at = 0;
    kernel.setArg(at++, out);
    kernel.setArg(at++, in);
    if (!s.about_facet) kernel.setArg(at++, smx::to_device(s.x));
    kernel.setArg(at++, lobes);
    kernel.setArg(at++, static_cast<cl_int>(s.lobes.size()));
    kernel.setArg(at++, to_float4(s.wo));
    if (s.about_facet) kernel.setArg(at++, to_float4(s.wm));
    device().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(u.size()));
    std::vector<cl_float4> values(u.size());
    device().queue().enqueueReadBuffer(out, CL_TRUE, 0, values.size() * sizeof values[0], values.data());
    std::vector<Draw> draws;
    for (const cl_float4 &v : values) draws.push_back({{v.s[0], v.s[1], v.s[2]}, v.s[3]});
    return draws;
}

// A direction in the frame that lobes are round or elliptic in: z is the mean normal or the facet's.
class Frame {
  public:
    explicit Frame(const Setting &s) : z_(s.wm) {
        const Vec far = std::abs(z_.x) < 0.5 ? Vec{1.0, 0.0, 0.0} : Vec{0.0, 1.0, 0.0};
        x_ = s.about_facet ? oracle::normalised(oracle::cross(far, z_)) : Vec{1.0, 0.0, 0.0};
        y_ = oracle::cross(z_, x_);
    }
    Vec operator()(const Vec &w) const { return {oracle::dot(w, x_), oracle::dot(w, y_), oracle::dot(w, z_)}; }

  private:
    Vec x_, y_, z_;
};

// A lobe as the plane of its slopes, each of two coordinates distributed as exp(-t^2) / sqrt(pi).
struct Plane {
    double alpha_1, alpha_2, axis_x, axis_y, mean_x, mean_y;

    Plane(const Setting &s, std::size_t lobe) : Plane(s.lobes[lobe].alpha, s.about_facet ? smx::Displacement{} : s.x) {}
    Plane(double alpha, const smx::Displacement &x) : mean_x(x.mean_slope_x), mean_y(x.mean_slope_y) {
        const smx::PrincipalAxes axes = smx::principal_axes(x);
        alpha_1 = std::sqrt(alpha * alpha + axes.var_1), alpha_2 = std::sqrt(alpha * alpha + axes.var_2);
        axis_x = axes.axis_x, axis_y = axes.axis_y;
    }
    // Of the facet that reflects one to the other.
    std::array<double, 2> at(const Vec &wi, const Vec &wo) const {
        const double dx = -(wi.x + wo.x) / (wi.z + wo.z) - mean_x, dy = -(wi.y + wo.y) / (wi.z + wo.z) - mean_y;
        return {(axis_x * dx + axis_y * dy) / alpha_1, (axis_x * dy - axis_y * dx) / alpha_2};
    }
    Vec normal(double t1, double t2) const {
        const double d1 = alpha_1 * t1, d2 = alpha_2 * t2;
        return oracle::normalised({-(mean_x + axis_x * d1 - axis_y * d2), -(mean_y + axis_y * d1 + axis_x * d2), 1.0});
    }
    double p22(const std::array<double, 2> &t) const {
        return std::exp(-t[0] * t[0] - t[1] * t[1]) / (oracle::pi * alpha_1 * alpha_2);
    }
};

// Cells of equal mass of a part, and one for what is refused.
struct Cells {
    std::vector<double> counts = std::vector<double>(side * side + 1);

    static std::size_t index(double u) { return std::min(static_cast<std::size_t>(u * side), side - 1); }
    void add(double u, double v) { counts[index(u) * side + index(v)] += 1.0; }

    // Cells of which less than ten draws are expected are one.
    double p_value(const std::vector<double> &shares) const {
        double statistic = 0.0, few = 0.0, few_expected = 0.0, all = 0.0;
        int cells = -1;
        for (const double count : counts) all += count;
        const auto take = [&](double count, double expected) {
            statistic += std::pow(count - expected, 2) / expected;
            ++cells;
        };
        for (std::size_t k = 0; k < counts.size(); ++k)
            if (all * shares[k] >= 10.0)
                take(counts[k], all * shares[k]);
            else
                few += counts[k], few_expected += all * shares[k];
        if (few_expected > 0.5)
            take(few, few_expected);
        else if (few > 10.0)
            return 0.0;
        if (cells < 1) return statistic < 1.0 ? 1.0 : 0.0;
        return boost::math::cdf(boost::math::complement(boost::math::chi_squared(cells), statistic));
    }
};

double below(double t) { return 0.5 * std::erfc(-t); }

// Cells of a lobe, from the directions that it drew.
Cells cells_of(const std::vector<Draw> &draws, const Setting &s, const Plane &plane) {
    const Frame frame(s);
    const Vec wo = frame(s.wo);
    Cells cells;
    for (const Draw &d : draws) {
        if (d.density == 0.0) {
            cells.counts.back() += 1.0;
            continue;
        }
        const auto [t1, t2] = plane.at(frame(d.wi), wo);
        cells.add(below(t1), below(t2));
    }
    return cells;
}

// Of each cell's facets, those that reflect wo to above the surface; the others' draws are refused.
std::vector<double> shares_of_cells(const Setting &s, const Plane &plane) {
    // Masses 3 w^2 - 2 w^3 of even w: the ends, which may reflect to below, are fine.
    constexpr std::size_t fine = 1024;
    const Vec wo = Frame(s)(s.wo);
    std::vector<double> t, mass, shares(side * side + 1);
    std::vector<std::size_t> cell;
    for (std::size_t k = 0; k < fine; ++k) {
        const double w = (static_cast<double>(k) + 0.5) / fine, u = w * w * (3.0 - 2.0 * w);
        t.push_back(-boost::math::erfc_inv(2.0 * u));
        mass.push_back(6.0 * w * (1.0 - w) / fine);
        cell.push_back(Cells::index(u));
    }
    for (std::size_t a = 0; a < fine; ++a)
        for (std::size_t b = 0; b < fine; ++b) {
            const Vec wm = plane.normal(t[a], t[b]);
            const bool above = oracle::dot(wo, wm) > 0.0 && oracle::reflect(wo, wm).z > 0.0;
            shares[above ? cell[a] * side + cell[b] : side * side] += mass[a] * mass[b];
        }
    return shares;
}

float random_float(test::Random &random) {
    return static_cast<float>((std::floor(random.uniform() * 0x1p23) + 0.5) * 0x1p-23);
}

// Numbers of which the first lies in a part's range: the cosine's, or that of lobe k.
std::vector<Three> numbers(double from, double to, uint64_t seed) {
    test::Random random(seed);
    std::vector<Three> u;
    while (u.size() < drawn) {
        const Three three{static_cast<float>(random.uniform(from, to)), random_float(random), random_float(random)};
        if (three[0] >= static_cast<float>(from) && three[0] < static_cast<float>(to)) u.push_back(three);
    }
    return u;
}

std::vector<Three> numbers_of_lobe(const Setting &s, std::size_t lobe, uint64_t seed) {
    double from = 0.0;
    for (std::size_t k = 0; k < lobe; ++k) from += s.share(k);
    // A rounding within its range, so that none is another lobe's.
    const auto at = [](double share) { return cosine_share + (1.0 - cosine_share) * share; };
    return numbers(at(from) + 1e-6, at(from + s.share(lobe)) - 1e-6, seed);
}

Vec view_at(double z, double phi) {
    const double r = std::sqrt((1.0 - z) * (1.0 + z));
    const Vec v{r * std::cos(phi), r * std::sin(phi), z};
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Surfaces and lobes whose slopes float32 tells from each other at these heights of wo: sharp ones from farther above.
std::vector<Setting> settings() {
    const smx::Displacement none{}, wide{0.3, 0.2, 0.5, 0.1, -0.2}, thin{0.3, 0.3, 0.999, 0.0, 0.0},
        line{0.5, 0.0, 0.0, 0.0, 0.0}, other_line{0.0, 0.5, 0.0, 0.1, 0.0}, huge{1e3, 10.0, 0.0, 3.0, 0.0};
    const Lobes sharp{{1.0, 1e-4}}, two{{0.3, 1e-3}, {0.7, 0.5}}, far{{0.5, 1e-4}, {0.5, 1e3}},
        three{{0.5, 0.1}, {1e-6, 0.3}, {0.5, 1.0}};
    std::vector<Setting> list;
    for (const double z : {1.0, 0.7, 0.1}) {
        list.push_back({sharp, none, view_at(z, 0.7)});
        list.push_back({far, none, view_at(z, 2.0)});
        list.push_back({two, line, view_at(z, 0.3)});
        list.push_back({three, wide, view_at(z, -1.0)});
        list.push_back({two, thin, view_at(z, 0.8)});
        list.push_back({two, huge, view_at(z, 1.0)});
        list.push_back({three, other_line, view_at(z, 3.0)});
    }
    for (const double z : {1e-2, 1e-3, 1e-5}) {
        list.push_back({{{1.0, 0.3}}, none, view_at(z, 0.7)});
        list.push_back({three, wide, view_at(z, 3.0)});
    }
    return list;
}

std::vector<Setting> facets() {
    const Lobes lobes[] = {{{1.0, 1e-4}}, {{0.3, 1e-3}, {0.7, 0.5}}, {{0.5, 1e-4}, {0.5, 1e3}}};
    std::vector<Setting> list;
    for (const Lobes &l : lobes)
        for (const Vec &wm : {Vec{0.0, 0.0, 1.0}, view_at(0.3, 2.0), view_at(-0.999, 1.0)})
            for (const double z : {1.0, 0.6, 0.1}) {
                const Setting upright{l, {}, {}, true, wm};
                // wo at this cosine from wm.
                const Vec side_of = oracle::normalised(oracle::cross(wm, {0.3, 0.9, -0.1}));
                const double r = std::sqrt((1.0 - z) * (1.0 + z));
                Setting s = upright;
                const Vec wo{z * wm.x + r * side_of.x, z * wm.y + r * side_of.y, z * wm.z + r * side_of.z};
                s.wo = {static_cast<float>(wo.x), static_cast<float>(wo.y), static_cast<float>(wo.z)};
                list.push_back(s);
            }
    return list;
}

std::vector<Setting> all_settings() {
    std::vector<Setting> all = settings();
    for (const Setting &s : facets()) all.push_back(s);
    return all;
}

} // namespace

TEST(DrawLight, LobesAreDrawnByTheirSlopes) {
    uint64_t seed = 0;
    for (const Setting &s : all_settings())
        for (std::size_t k = 0; k < s.lobes.size(); ++k) {
            const Plane plane(s, k);
            const Cells cells = cells_of(draw(s, numbers_of_lobe(s, k, ++seed)), s, plane);
            EXPECT_GT(cells.p_value(shares_of_cells(s, plane)), significance / number_of_tests)
                << s.name() << ", lobe " << k;
        }
}

// And are refused where the lobe is a twentieth too wide.
TEST(DrawLight, ATwentiethIsSeen) {
    for (Setting s : {settings()[3], facets()[3]}) {
        const std::vector<Draw> draws = draw(s, numbers_of_lobe(s, 0, 1));
        for (smx::Lobe &lobe : s.lobes) lobe.alpha *= 1.05;
        if (!s.about_facet) s.x.alpha_x *= 1.05, s.x.alpha_y *= 1.05;
        const Plane wider(s, 0);
        EXPECT_LT(cells_of(draws, s, wider).p_value(shares_of_cells(s, wider)), 1e-6) << s.name();
    }
}

TEST(DrawLight, TheCosineIsDrawnByCosines) {
    const std::vector<double> even = [] {
        std::vector<double> shares(side * side + 1, 1.0 / (side * side));
        shares.back() = 0.0;
        return shares;
    }();
    uint64_t seed = 300;
    for (const Setting &s : {settings()[0], settings()[5], settings().back(), facets()[0], facets()[5], facets()[8]}) {
        const Frame frame(s);
        Cells cells, tilted;
        for (const Draw &d : draw(s, numbers(0.0, cosine_share, ++seed))) {
            ASSERT_GT(d.density, 0.0);
            const Vec wi = frame(d.wi);
            const double phi = std::atan2(wi.y, wi.x) / (2.0 * oracle::pi) + 0.5;
            cells.add(wi.z * wi.z, phi), tilted.add(wi.z, phi);
        }
        EXPECT_GT(cells.p_value(even), significance / number_of_tests) << s.name();
        EXPECT_LT(tilted.p_value(even), 1e-6);
    }
}

namespace {

// Density of all parts at wi, and the relative error that roundings of directions make of it.
struct Density {
    double value, error;
    bool has_lost_lobe; // one whose exponential is no normal float
};

Density density_at(const Setting &s, const Vec &wi_world) {
    const Frame frame(s);
    const Vec wi = frame(wi_world), wo = frame(s.wo), sum = wi + wo;
    const double length = oracle::length(sum), hz = sum.z / length;
    const double slope = std::hypot(sum.x, sum.y) / sum.z;
    const double of_cosine = cosine_share * wi.z / oracle::pi;
    Density d{of_cosine, of_cosine * (s.about_facet ? 1.0 + 4.0 / wi.z : 1.0), false};
    for (std::size_t k = 0; k < s.lobes.size(); ++k) {
        const Plane plane(s, k);
        const std::array<double, 2> t = plane.at(wi, wo);
        const double value = (1.0 - cosine_share) * s.share(k) * plane.p22(t) / (hz * hz * hz * 2.0 * length);
        // A slope is a quotient of sums; about a facet its height is a sum of three products.
        const double moved =
            2.0 / sum.z + slope * (s.about_facet ? 1.0 + 2.0 / sum.z : 1.0) + std::hypot(plane.mean_x, plane.mean_y);
        const double cond = 2.0 * (std::abs(t[0]) / plane.alpha_1 + std::abs(t[1]) / plane.alpha_2) * moved +
                            4.0 * (s.about_facet ? 1.0 + 1.0 / sum.z : 1.0);
        d.value += value;
        d.error += value * (1.0 + cond);
        d.has_lost_lobe = d.has_lost_lobe || t[0] * t[0] + t[1] * t[1] > 87.5;
    }
    d.error *= roundings / d.value;
    return d;
}

std::vector<Three> any_numbers(uint64_t seed) {
    test::Random random(seed);
    std::vector<Three> u;
    for (std::size_t k = 0; k < 4096; ++k)
        u.push_back({random_float(random), random_float(random), random_float(random)});
    return u;
}

// More: grazing, and lobes and surfaces at their bounds.
std::vector<Setting> hard_settings() {
    std::vector<Setting> all = all_settings();
    for (const double z : {1.0, 0.3, 1e-3, 1e-5, 1e-7})
        for (const double alpha : {1e-4, 1e-2, 1.0, 1e4})
            for (const smx::Displacement &x : {smx::Displacement{},
                                               {1e-7, 1e3, 0.0, 0.0, 0.0},
                                               {1e4, 1e4, 0.9, 30.0, -3.0},
                                               {0.3, 0.3, -1.0 + 1e-6, 0.0, 0.0}})
                all.push_back({{{0.5, alpha}, {0.5, 1e-4}}, x, view_at(z, 1.0)});
    for (Setting s : facets()) {
        const Vec away = oracle::normalised(oracle::cross(s.wm, s.wo));
        for (const double z : {1e-3, 1e-6}) {
            const Vec wo = oracle::normalised({away.x + z * s.wm.x, away.y + z * s.wm.y, away.z + z * s.wm.z});
            s.wo = {static_cast<float>(wo.x), static_cast<float>(wo.y), static_cast<float>(wo.z)};
            if (oracle::dot(s.wo, s.wm) > 0.0) all.push_back(s);
        }
    }
    return all;
}

} // namespace

// A lobe's exponential that is lost below 2^-126 is lost beside the cosine, or beside the lobe that the direction is
// from, whose own is above exp(-17): no draw has a density of 0, nor one that misses anything.
TEST(DrawLight, DensitiesAreOfAllParts) {
    std::size_t determined = 0, lost = 0, all = 0;
    double largest = 0.0;
    uint64_t seed = 600;
    for (const Setting &s : hard_settings())
        for (const Draw &d : draw(s, any_numbers(++seed))) {
            if (d.density == 0.0) continue;
            ++all;
            ASSERT_TRUE(std::isfinite(d.density) && d.density > 0.0) << s.name();
            const Density wanted = density_at(s, d.wi);
            if (!(wanted.error < 1.0)) continue;
            ++determined, lost += wanted.has_lost_lobe;
            largest = std::max(largest, std::abs(d.density / wanted.value - 1.0) / wanted.error);
            ASSERT_TRUE(test::is_close(d.density, wanted.value, wanted.error, 0.0))
                << s.name() << ", wi " << d.wi.x << " " << d.wi.y << " " << d.wi.z << ": " << d.density << ", wanted "
                << wanted.value << " to a share " << wanted.error;
        }
    std::printf(
        "%zu densities, %zu of them determined, %zu with a lobe that is lost; error at most %.2f of its bound\n", all,
        determined, lost, largest);
    EXPECT_GT(determined, all / 2);
    EXPECT_GT(lost, determined / 10);
}

// A direction of length 1 and of some density, or none.
TEST(DrawLight, EndsOfTheUniformNumbersAreFinite) {
    const float most = 1.0f - 0x1p-24f, cosine = static_cast<float>(cosine_share);
    std::vector<Three> u;
    for (const float a : {0.0f, 0x1p-24f, cosine - 0x1p-26f, cosine, cosine + 0x1p-25f, 0.5f, most})
        for (const float b : {0.0f, 0x1p-24f, 0.5f, most})
            for (const float c : {0.0f, 0x1p-24f, 0.5f, most}) u.push_back({a, b, c});
    std::vector<Setting> all = hard_settings();
    for (const double z : {1e-12, 1e-20, 1e-30}) {
        all.push_back({{{0.5, 1e-4}, {0.5, 1e4}}, {}, view_at(z, 0.0)});
        all.push_back({{{0.5, 1e-4}, {0.5, 1e4}}, {}, view_at(z, 0.0), true});
    }
    for (const Setting &s : all) {
        std::size_t taken = 0;
        const std::vector<Draw> draws = draw(s, u);
        for (std::size_t k = 0; k < u.size(); ++k) {
            const Draw &d = draws[k];
            ASSERT_TRUE(std::isfinite(d.density) && d.density >= 0.0)
                << s.name() << ", draw " << k << ": " << d.density;
            ASSERT_NEAR(oracle::dot(d.wi, d.wi), 1.0, 1e-5) << s.name() << ", draw " << k;
            taken += d.density > 0.0;
        }
        EXPECT_GE(taken, u.size() / 8) << s.name(); // the cosine's at least
    }
}
