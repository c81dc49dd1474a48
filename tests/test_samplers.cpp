// The reference's samplers against their densities: the uniform numbers and their ends, the slopes' quantile, and the
// drawn facets, counted in cells of equal probability (chi-square; Bonferroni's correction for the number of tests) and
// compared with the density that is stored beside them.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <numeric>

#include "close.h"
#include "context.h"
#include "device_buffer.h"
#include "oracle.h"
#include "random.h"
#include "sampling_parts.h"

namespace {

// One run of this file in a thousand refuses samplers that are right.
constexpr double significance = 1e-3;
constexpr int number_of_tests = 40; // at least as many as p-values are asked for below
// Float roundings of normals and densities, times what their condition makes of them (16 eps (1 + cond)).
constexpr double roundings = 16 * 0x1p-24;
constexpr std::size_t drawn = 1 << 18;

smx::Context &context() {
    static smx::Context c("", 0);
    return c;
}

// Points of the unit square, counted in equal squares.
class Cells {
  public:
    void add(double u, double v) {
        ++counts_[index(u) * side + index(v)];
        ++total_;
    }
    // Chance of a statistic this large. Points that are more even than independent ones make the chance larger.
    double p_value() const {
        const double expected = static_cast<double>(total_) / static_cast<double>(counts_.size());
        double statistic = 0.0;
        for (const std::size_t count : counts_)
            statistic += std::pow(static_cast<double>(count) - expected, 2) / expected;
        const boost::math::chi_squared distribution(static_cast<double>(counts_.size() - 1));
        return boost::math::cdf(boost::math::complement(distribution, statistic));
    }
    bool are_even() const { return p_value() > significance / number_of_tests; }

  private:
    static constexpr std::size_t side = 16;
    static std::size_t index(double u) { return std::min(static_cast<std::size_t>(std::max(u, 0.0) * side), side - 1); }
    std::vector<std::size_t> counts_ = std::vector<std::size_t>(side * side);
    std::size_t total_ = 0;
};

// `expression`, a float2, of three unsigned numbers a, b, c.
using Three = std::array<cl_uint, 3>;
std::vector<std::array<float, 2>> probe(const std::string &expression, const std::vector<Three> &in) {
    const std::string source = smx::kernel_source("quantile.clh") + smx::kernel_source("random.clh") + R"(
__kernel void probe(__global float2 *out, __global const uint *in) {
    size_t at = get_global_id(0);
    uint a = in[3 * at], b = in[3 * at + 1], c = in[3 * at + 2];
    out[at] = )" + expression + ";\n}";
    cl::Program program(context().cl(), source);
    program.build();
    cl::Kernel kernel(program, "probe");
    std::vector<std::array<float, 2>> result(in.size());
    const cl::Buffer out = smx::empty_buffer<cl_float2>(context(), in.size()), buffer = smx::buffer_from(context(), in);
    kernel.setArg(0, out);
    kernel.setArg(1, buffer);
    context().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(in.size()));
    context().queue().enqueueReadBuffer(out, CL_TRUE, 0, in.size() * sizeof result[0], result.data());
    return result;
}

// The planes that draw_facets.cl writes.
struct Facets {
    std::vector<float> values;
    double at(std::size_t plane, std::size_t k) const { return values[plane * drawn + k]; }
};

// set(kernel) gives the arguments from number 4.
template <typename Set>
Facets draw(const char *name, cl_uint seed, Set set) {
    cl::Kernel kernel = context().kernel("draw_facets.cl", name);
    const cl::Buffer buffer = smx::empty_buffer<float>(context(), 5 * drawn);
    kernel.setArg(0, buffer);
    kernel.setArg(1, static_cast<cl_int>(drawn));
    constexpr auto size = static_cast<cl_int>(drawn);
    kernel.setArg(2, smx::Part{0, 1, 0, size, size, 1, size});
    const cl::Buffer seeds = smx::buffer_from(context(), std::vector<cl_uint>{seed});
    kernel.setArg(3, seeds);
    set(kernel);
    context().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(drawn));
    Facets facets{std::vector<float>(5 * drawn)};
    context().queue().enqueueReadBuffer(buffer, CL_TRUE, 0, facets.values.size() * sizeof(float), facets.values.data());
    return facets;
}

Facets draw_grid(const smx::Displacement &x, cl_uint strata_1, cl_uint strata_2, cl_uint seed) {
    return draw("draw_grid", seed, [&](cl::Kernel &kernel) {
        kernel.setArg(4, smx::to_device(x));
        kernel.setArg(5, strata_1);
        kernel.setArg(6, strata_2);
    });
}

Facets draw_of_x(bool grid, const smx::Displacement &x, cl_uint seed) {
    if (grid) return draw_grid(x, 512, 512, seed);
    return draw("draw_sobol", seed, [&](cl::Kernel &kernel) { kernel.setArg(4, smx::to_device(x)); });
}

const std::vector<smx::Displacement> &surfaces() {
    static const std::vector<smx::Displacement> list{
        {0.3, 0.3, 0.0, 0.0, 0.0},   {0.3, 0.2, 0.5, 0.1, -2.0},       {1e-4, 1.0, 0.0, 0.0, 0.0},
        {1e3, 0.1, 0.0, 0.0, 0.0},   {0.5, 0.5, 1.0 - 1e-6, 0.0, 0.0}, {1e-4, 1e-4, -0.9, 0.0, 0.0},
        {1e3, 1e3, 0.3, 50.0, -3.0},
    };
    return list;
}

// A slope of X, whitened: each of the two is distributed as exp(-t^2) / sqrt(pi).
struct White {
    double t1, t2;
    double cond; // of the density, over the slopes
};

White whiten(const smx::Displacement &x, double slope_x, double slope_y) {
    const double z = (slope_x - x.mean_slope_x) / x.alpha_x, w = (slope_y - x.mean_slope_y) / x.alpha_y;
    const double free = (1.0 - x.rho) * (1.0 + x.rho);
    const double by_x = 2.0 * (z - x.rho * w) / (free * x.alpha_x), by_y = 2.0 * (w - x.rho * z) / (free * x.alpha_y);
    const double size_x = std::max(std::abs(slope_x), std::abs(x.mean_slope_x));
    const double size_y = std::max(std::abs(slope_y), std::abs(x.mean_slope_y));
    return {z, (w - x.rho * z) / std::sqrt(free), std::abs(by_x) * size_x + std::abs(by_y) * size_y};
}

double mass_below(double t) { return std::erfc(-t) / 2.0; }

Cells cells_of_x(const Facets &facets, const smx::Displacement &x) {
    Cells cells;
    for (std::size_t k = 0; k < drawn; ++k) {
        const White at = whiten(x, -facets.at(0, k) / facets.at(2, k), -facets.at(1, k) / facets.at(2, k));
        cells.add(mass_below(at.t1), mass_below(at.t2));
    }
    return cells;
}

// Facets of a surface that is rough along y only, a stratum each.
class LineFacets {
  public:
    LineFacets(cl_uint strata, cl_uint seed) : strata_(strata), facets_(draw_grid(x_, 1, strata, seed)) {}
    // Of the density's mass, what is below facet k, and its stratum's share.
    double mass_at(std::size_t k) const { return mass_below(-facets_.at(1, k) / facets_.at(2, k) / x_.alpha_y); }
    double mass_of(std::size_t k) const { return facets_.at(3, k) * facets_.at(2, k) / strata_; }

  private:
    static constexpr smx::Displacement x_{0.0, 0.3, 0.0, 0.0, 0.0};
    cl_uint strata_;
    Facets facets_;
};

using Lobes = std::vector<smx::Lobe>;

std::vector<Lobes> proposals() {
    Lobes many;
    for (int k = 0; k < 64; ++k) many.push_back({1.0 / 64, 1e-4 * std::pow(10.0, k / 9.0)});
    return {{{1.0, 0.1}},
            {{0.5, 1e-3}, {0.5, 0.5}},
            {{0.3, 1e-4}, {0.7, 1e3}},
            {{0.5, 0.1}, {1e-12, 0.3}, {0.5, 1.0}},
            many};
}

Facets draw_about_z(const Lobes &lobes, cl_uint seed) {
    const cl::Buffer lobe_buffer = smx::buffer_from(context(), smx::cumulated(lobes));
    const cl::Buffer density = smx::buffer_from(context(), smx::proposal_table(lobes));
    return draw("draw_about_z", seed, [&](cl::Kernel &kernel) {
        kernel.setArg(4, lobe_buffer);
        kernel.setArg(5, static_cast<cl_int>(lobes.size()));
        kernel.setArg(6, density);
    });
}

// Share of a mixture's slopes that are steeper.
double mass_beyond(const Lobes &lobes, double tangent2) {
    double sum = 0.0;
    for (const smx::Lobe &lobe : lobes) sum += lobe.weight * std::exp(-tangent2 / (lobe.alpha * lobe.alpha));
    return sum;
}

double squared_tangent(const Facets &f, std::size_t k) {
    return std::pow(std::hypot(f.at(0, k), f.at(1, k)) / (1.0 + f.at(2, k)), 2);
}

Cells cells_about_z(const Facets &f, const Lobes &lobes) {
    Cells cells;
    for (std::size_t k = 0; k < drawn; ++k)
        cells.add(mass_beyond(lobes, squared_tangent(f, k)),
                  std::atan2(f.at(1, k), f.at(0, k)) / (2.0 * oracle::pi) + 0.5);
    return cells;
}

} // namespace

// Over seeds the points are independent: of one index, and of one scramble and the next.
TEST(Samplers, EveryPointIsUniformOverTheSeeds) {
    constexpr cl_uint seeds = 1 << 16;
    for (const cl_uint index : {0u, 1u, 2u, 3u, 77u, 65535u, 1u << 23}) {
        std::vector<Three> in;
        for (cl_uint seed = 0; seed < seeds; ++seed)
            in.push_back({index, smx::pass_seed(seed, 0, 0), smx::pass_seed(seed, 1, 0)});
        Cells within, between;
        for (const auto &[u, v] : probe("convert_float2(sobol_bits(a, b)) * 0x1p-32f", in)) within.add(u, v);
        const char *both = "(float2)(uniform_open(sobol_bits(a, b).x), uniform_open(sobol_bits(a, c).x))";
        for (const auto &[u, v] : probe(both, in)) between.add(u, v);
        EXPECT_TRUE(within.are_even()) << "index " << index << ": " << within.p_value();
        EXPECT_TRUE(between.are_even()) << "index " << index << ": " << between.p_value();
    }
}

TEST(Samplers, JitterIsUniformOverTheSeeds) {
    std::vector<Three> in;
    for (cl_uint seed = 0; seed < 1 << 16; ++seed) in.push_back({7u, smx::pass_seed(seed, 0, 0), 0u});
    Cells cells;
    const char *jitter = "(float2)(uniform_open(pcg(a ^ pcg(b))), uniform_open(pcg(pcg(a ^ pcg(b)) + 1u)))";
    for (const auto &[u, v] : probe(jitter, in)) cells.add(u, v);
    EXPECT_TRUE(cells.are_even()) << cells.p_value();
}

// Neither 0 nor 1 is drawn; the least and the largest are 2^-24 from them.
TEST(Samplers, UniformNumbersAreOpen) {
    const auto ends = probe("(float2)(uniform_open(a), uniform_open(b))", {{0u, 0xffffffffu, 0u}});
    EXPECT_EQ(ends[0][0], 0x1p-24f);
    EXPECT_EQ(ends[0][1], 1.0f - 0x1p-24f);
}

TEST(Samplers, QuantileHasItsStatedError) {
    constexpr double low = 0x1p-70, high = 0.5, stated = 9e-7;
    test::Random random(3);
    std::vector<Three> in;
    std::vector<float> q{static_cast<float>(low), static_cast<float>(high)};
    for (int k = 0; k < 100000; ++k) q.push_back(static_cast<float>(random.log_uniform(low, high)));
    for (const float value : q) in.push_back({std::bit_cast<cl_uint>(value), 0u, 0u});
    const auto t = probe("(float2)(slope_quantile(as_float(a)))", in);
    double largest = 0.0;
    for (std::size_t k = 0; k < q.size(); ++k) {
        const double wanted = -boost::math::erfc_inv(2.0 * q[k]);
        largest = std::max(largest, wanted == 0.0 ? std::abs(t[k][0]) : std::abs(t[k][0] / wanted - 1.0));
    }
    EXPECT_LE(largest, stated);
    EXPECT_GT(largest, stated / 2.0);
}

// At the ends of the unit interval, and in the middle, for every number of strata: finite, the quantile, antisymmetric.
TEST(Samplers, SlopesAtTheEndsOfTheirStrata) {
    const cl_uint least = 0u, most = 0xffffffffu;
    for (const cl_uint strata : {1u, 2u, 3u, 4096u, 65536u, 1u << 24})
        for (const cl_uint whole : {0u, strata / 2, strata - 1}) {
            const char *at =
                "(float2)(slope_at(a, b, 0, uniform_open(c)).t, slope_at(b - 1u - a, b, 0, 1.0f - uniform_open(c)).t)";
            for (const auto &[bits, fraction] : {std::pair{least, 0x1p-24}, std::pair{most, 1.0 - 0x1p-24}}) {
                const auto [there, back] = probe(at, {{whole, strata, bits}})[0];
                EXPECT_EQ(there, -back) << whole << " of " << strata;
                const double below = (whole + fraction) / strata, above = (strata - whole - fraction) / strata;
                const double wanted =
                    below < 0.5 ? -boost::math::erfc_inv(2.0 * below) : boost::math::erfc_inv(2.0 * above);
                // A stratum is told to 2^-24 of its distance from the end; the quantile's error is its own.
                EXPECT_CLOSE(there, wanted, 2e-6, 2e-7) << whole << " of " << strata << " + " << fraction;
            }
        }
}

// On a line facets' weights are their strata's masses: laid end to end they fill the density, and a facet lies anywhere
// in its own.
TEST(Samplers, FacetsOfALineLieInTheirStrata) {
    constexpr double rounding = 1e-6; // the quantile's, and those of a normal, as mass
    for (const cl_uint strata : {1u, 2u, 7u, 8u, 15u, 256u, 4096u, cl_uint{drawn}}) {
        const LineFacets line(strata, 16);
        double below = 0.0;
        for (std::size_t k = 0; k < strata; ++k) {
            ASSERT_GT(line.mass_at(k), below - rounding) << k << " of " << strata;
            below += line.mass_of(k);
            ASSERT_LT(line.mass_at(k), below + rounding) << k << " of " << strata;
        }
        EXPECT_CLOSE(below, 1.0, 1e-6, 0.0) << strata;
        const double equal = line.mass_of(strata / 2), outermost = line.mass_of(strata - 1);
        EXPECT_CLOSE(outermost / equal, strata < 8 ? 1.0 : 0.5 / (strata / 8), 1e-6, 0.0) << strata;
    }
}

TEST(Samplers, FacetsOfALineAreUniformInTheirStrata) {
    constexpr cl_uint strata = 256;
    Cells cells, shifted;
    for (cl_uint seed = 0; seed < 64; ++seed) {
        const LineFacets line(strata, seed);
        double below = 0.0, last = 0.0;
        for (std::size_t k = 0; k < strata; below += line.mass_of(k++)) {
            const double place = (line.mass_at(k) - below) / line.mass_of(k);
            if (k % 2 == 1) cells.add(place, last), shifted.add(place * place, last);
            last = place;
        }
    }
    EXPECT_TRUE(cells.are_even()) << cells.p_value();
    EXPECT_FALSE(shifted.are_even());
}

TEST(Samplers, FacetsOfXHaveItsDensity) {
    for (const bool grid : {true, false})
        for (const smx::Displacement &x : surfaces()) {
            const Cells cells = cells_of_x(draw_of_x(grid, x, 11), x);
            EXPECT_TRUE(cells.are_even()) << (grid ? "grid " : "sobol ") << x.alpha_x << " " << x.alpha_y << " rho "
                                          << x.rho << ": " << cells.p_value();
        }
    smx::Displacement wider = surfaces()[0];
    wider.alpha_x *= 1.05;
    EXPECT_FALSE(cells_of_x(draw_of_x(false, surfaces()[0], 11), wider).are_even());
}

TEST(Samplers, FacetsOfXKnowTheirDensity) {
    for (const smx::Displacement &x : surfaces()) {
        const Facets f = draw_of_x(false, x, 12);
        const oracle::Gaussian g = oracle::gaussian(x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y);
        for (std::size_t k = 0; k < drawn; ++k) {
            const oracle::Vec m{f.at(0, k), f.at(1, k), f.at(2, k)};
            ASSERT_NEAR(oracle::length(m), 1.0, 4e-7);
            ASSERT_GT(m.z, 0.0);
            ASSERT_TRUE(test::is_close(f.at(3, k) * m.z, 1.0, roundings, 0.0));
            const double slope_x = -m.x / m.z, slope_y = -m.y / m.z;
            const double wanted = oracle::p22(g, slope_x, slope_y) / (m.z * m.z * m.z);
            const double cond = whiten(x, slope_x, slope_y).cond + 3.0;
            ASSERT_TRUE(test::is_close(f.at(4, k), wanted, roundings * (1.0 + cond), 0.0))
                << x.alpha_x << " " << x.alpha_y << " rho " << x.rho << ", slope " << slope_x << " " << slope_y << ": "
                << f.at(4, k) << ", wanted " << wanted << ", cond " << cond;
        }
    }
}

TEST(Samplers, FacetsOfTheProposalHaveItsDensity) {
    for (const Lobes &lobes : proposals()) {
        const Cells cells = cells_about_z(draw_about_z(lobes, 13), lobes);
        EXPECT_TRUE(cells.are_even()) << lobes.size() << " lobes from " << lobes[0].alpha << ": " << cells.p_value();
    }
    EXPECT_FALSE(cells_about_z(draw_about_z({{1.0, 0.1}}, 13), {{1.0, 0.105}}).are_even());
}

// What is kept beside them is the tabulated density over the true one.
TEST(Samplers, FacetsOfTheProposalKnowTheirCorrection) {
    for (const Lobes &lobes : proposals()) {
        const Facets f = draw_about_z(lobes, 14);
        const std::vector<float> table = smx::proposal_table(lobes);
        for (std::size_t k = 0; k < drawn; ++k) {
            ASSERT_NEAR(std::hypot(f.at(0, k), f.at(1, k), 1.0 + f.at(2, k)), 1.0, 4e-7);
            const double tangent2 = squared_tangent(f, k), inv_cos2 = 1.0 + tangent2;
            double p22 = 0.0, slope = 0.0; // and its derivative by the logarithm of tangent2
            for (const smx::Lobe &lobe : lobes) {
                const double a2 = lobe.alpha * lobe.alpha;
                const double share = lobe.weight / (oracle::pi * a2) * std::exp(-tangent2 / a2);
                p22 += share, slope += share * tangent2 / a2;
            }
            const auto last = static_cast<double>(table.size() - 1);
            const double row = last * std::sqrt(std::atan(std::sqrt(tangent2)) * 2.0 / oracle::pi);
            const auto below = static_cast<std::size_t>(std::min(row, last - 1.0));
            const double a = table[below], b = table[below + 1];
            const double wanted = std::lerp(a, b, row - static_cast<double>(below)) / (p22 * std::pow(inv_cos2, 1.5));
            const double cond = 2.0 * slope / p22 + 3.0 * inv_cos2; // z - 1 is kept, z is not
            const double of_row = roundings * row * std::abs(b - a) / (p22 * std::pow(inv_cos2, 1.5));
            ASSERT_TRUE(test::is_close(f.at(3, k), wanted, roundings * (1.0 + cond), of_row))
                << lobes.size() << " lobes from " << lobes[0].alpha << ", tangent " << std::sqrt(tangent2) << ": "
                << f.at(3, k) << ", wanted " << wanted << ", cond " << cond;
        }
    }
}
