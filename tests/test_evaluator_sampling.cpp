// Directions drawn by smx_evaluator_sample: against their density by chi-square, over the hard cases' alphas and
// angles; the bound of their weights; the ends of the uniform numbers.
#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numeric>

#include "context.h"
#include "device_buffer.h"
#include "random.h"
#include "scene.h"
#include "support.h"

using oracle::Lobe;
using oracle::Vec;

namespace {

using Evaluator = test::Handle<smx_evaluator, smx_evaluator_release>;

constexpr std::size_t side = 16, drawn = 1 << 16;

// One run of this file in a thousand refuses a sampler that is right.
constexpr double significance = 1e-3;
constexpr int number_of_tests = 300; // at least as many as p-values are asked for below

Evaluator make_evaluator(smx_material material, const smx_displacement &x, smx_grade grade = SMX_GRADE_PRECISE,
                         int32_t order = 0) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.grade = grade;
    options.widening_order = order;
    Evaluator e;
    EXPECT_SMX_OK(smx_evaluator_create(test::context(), material, &x, SMX_G2_CORRELATED, &options, e.out()));
    return e;
}

struct Draws {
    std::vector<float> wi, fcos, pdf;
    Vec at(std::size_t k) const { return {wi[3 * k], wi[3 * k + 1], wi[3 * k + 2]}; }
};

// All from one wo.
Draws draw(const Evaluator &e, const Vec &wo, const std::vector<float> &u) {
    const std::size_t count = u.size() / 3;
    std::vector<float> views;
    for (std::size_t k = 0; k < count; ++k)
        for (const double v : {wo.x, wo.y, wo.z}) views.push_back(static_cast<float>(v));
    Draws d = {std::vector<float>(u.size()), std::vector<float>(u.size()), std::vector<float>(count)};
    const smx_vectors uniform = SMX_PACKED(u.data()), view = SMX_PACKED(views.data());
    const smx_vectors_out wi = SMX_PACKED(d.wi.data()), fcos = SMX_PACKED(d.fcos.data());
    const smx_scalars_out pdf = {d.pdf.data(), 1};
    EXPECT_SMX_OK(smx_evaluator_sample(e, count, &uniform, &view, &wi, &fcos, &pdf));
    return d;
}

std::vector<float> independent_numbers(uint64_t seed) {
    test::Random random(seed);
    std::vector<float> u;
    for (std::size_t k = 0; k < 3 * drawn; ++k)
        u.push_back(static_cast<float>(0x1p-24 * std::floor(random.uniform() * 0x1p24)));
    return u;
}

Vec view_at(double z, double phi) {
    const double r = std::sqrt((1.0 - z) * (1.0 + z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

// A surface's slopes that wo sees, as two independent uniform numbers: the shares of slopes below, along wo and across.
// Along, (v - t) exp(-t^2) has the integral v sqrt(pi)/2 erfc(-t) + exp(-t^2)/2.
struct VisibleSlopes {
    double a = 0.0, b = 0.0, c = 0.0; // lower Cholesky factor of twice the covariance: slope = mean + L t
    double mean_x = 0.0, mean_y = 0.0;
    double e1 = 1.0, e2 = 0.0, v = 0.0;

    VisibleSlopes(const oracle::Gaussian &g, const Vec &wo) : mean_x(g.mean_x), mean_y(g.mean_y) {
        a = std::sqrt(2.0 * g.cov_xx);
        b = 2.0 * g.cov_xy / a;
        c = std::sqrt(2.0 * g.cov_yy - b * b);
        const double t1 = a * wo.x + b * wo.y, t2 = c * wo.y, s = std::hypot(t1, t2);
        if (s > 0.0) e1 = t1 / s, e2 = t2 / s;
        v = s > 0.0 ? oracle::plane(g, wo) / s : 1e300;
    }
    static double below(double t) { return 0.5 * std::erfc(-t); }
    std::array<double, 2> shares(const Vec &wh) const {
        const double dx = -wh.x / wh.z - mean_x, dy = -wh.y / wh.z - mean_y;
        const double t1 = dx / a, t2 = (dy - b * t1) / c;
        const double along = std::min(e1 * t1 + e2 * t2, v), across = e1 * t2 - e2 * t1;
        const auto mass = [&](double t) {
            return below(t) + (v < 1e299 ? std::exp(-t * t) / (2.0 * std::sqrt(oracle::pi) * v) : 0.0);
        };
        // At grazing v is 0, and the ratio its limit.
        const double share = v > 0.0 ? mass(along) / mass(v) : std::exp(-along * along);
        return {share, below(across)};
    }
};

class Cells {
  public:
    void add(const std::array<double, 2> &shares) {
        const auto index = [](double s) {
            return std::min(static_cast<std::size_t>(std::max(s, 0.0) * side), side - 1);
        };
        ++counts_[index(shares[0]) * side + index(shares[1])];
    }
    // Chance of counts as far as these from what is expected.
    double p_value(const std::vector<double> &expected) const {
        double statistic = 0.0;
        for (std::size_t k = 0; k < counts_.size(); ++k) {
            const double wanted = expected[k] * static_cast<double>(drawn);
            statistic += std::pow(static_cast<double>(counts_[k]) - wanted, 2) / wanted;
        }
        const boost::math::chi_squared distribution(static_cast<double>(counts_.size() - 1));
        return boost::math::cdf(boost::math::complement(distribution, statistic));
    }
    double p_value_even() const { return p_value(std::vector<double>(counts_.size(), 1.0 / (side * side))); }

  private:
    std::vector<std::size_t> counts_ = std::vector<std::size_t>(side * side);
};

Vec half(const Vec &wi, const Vec &wo) { return oracle::normalised(wi + wo); }

smx::Context &device() {
    static smx::Context c("", 0);
    return c;
}

// Normals as cl/visible_normals.clh draws them. (Of a direction that is drawn at grazing, float32 does not tell its
// facet any more.)
std::vector<float> drawn_normals(double alpha, const smx_displacement &x, const Vec &wo, int grade,
                                 const std::vector<float> &u) {
    static const std::string source = smx::kernel_source("visible_normals.clh") + R"(
__kernel void probe(__global float *m, __global const float *u, Displacement x, real alpha2, float ox, float oy,
                    float oz) {
    size_t at = 3 * get_global_id(0);
    VectorW wo = {ox, oy, oz};
    VectorW v = visible_normal(&x, alpha2, wo, mean_plane(&x, ox, oy, oz), u[at + 1], u[at + 2]);
    m[at] = (float)v.x, m[at + 1] = (float)v.y, m[at + 2] = (float)v.z;
})";
    cl::Program program(device().cl(), source);
    program.build(smx::build_options({{"GRADE", grade}}).c_str());
    cl::Kernel kernel(program, "probe");
    const cl::Buffer out = smx::empty_buffer<float>(device(), u.size()), in = smx::buffer_from(device(), u);
    const smx::Displacement surface = {x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y};
    kernel.setArg(0, out);
    kernel.setArg(1, in);
    if (grade == SMX_GRADE_DOUBLE) {
        kernel.setArg(2, smx::to_device<double>(surface));
        kernel.setArg(3, alpha * alpha);
    } else {
        kernel.setArg(2, smx::to_device<float>(surface));
        kernel.setArg(3, static_cast<float>(alpha * alpha));
    }
    kernel.setArg(4, static_cast<float>(wo.x));
    kernel.setArg(5, static_cast<float>(wo.y));
    kernel.setArg(6, static_cast<float>(wo.z));
    device().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(u.size() / 3));
    std::vector<float> m(u.size());
    device().queue().enqueueReadBuffer(out, CL_TRUE, 0, m.size() * sizeof m[0], m.data());
    return m;
}

double p_value_of(double alpha, const smx_displacement &x, const Vec &view, smx_grade grade, uint64_t seed) {
    const Vec wo = {double{static_cast<float>(view.x)}, double{static_cast<float>(view.y)},
                    double{static_cast<float>(view.z)}};
    const std::vector<float> m = drawn_normals(alpha, x, wo, grade, independent_numbers(seed));
    const VisibleSlopes slopes(oracle::widened(test::gaussian(x), alpha), wo);
    Cells cells;
    for (std::size_t k = 0; k < drawn; ++k) cells.add(slopes.shares({m[3 * k], m[3 * k + 1], m[3 * k + 2]}));
    return cells.p_value_even();
}

} // namespace

// Beside each angle, what float32 directions leave of a slope: 1e-7 over the sine of wh's angle with grazing ... so
// that the least alpha is drawn from 1e-3 of the horizon up, and wider ones to 1e-7.
TEST(Drawn, AreVisibleNormalsOverTheHardCases) {
    uint64_t seed = 1;
    for (const double alpha : {1e-4, 1e-3, 1e-2, 0.1, 1.0, 3.0, 30.0, 1e3})
        for (const double z : {1.0, 0.999999, 0.7, 0.1, 1e-3, 1e-5, 1e-7}) {
            const Vec wo = view_at(z, 0.7);
            EXPECT_GT(p_value_of(alpha, {0.0, 0.0, 0.0, 0.0, 0.0}, wo, SMX_GRADE_PRECISE, ++seed),
                      significance / number_of_tests)
                << "alpha " << alpha << ", cosine of wo " << z;
        }
}

TEST(Drawn, AreVisibleNormalsOfDisplacedSurfaces) {
    uint64_t seed = 100;
    for (const smx_displacement &x : {smx_displacement{0.25, 0.25, 0.0, 0.0, 0.0},
                                      {0.5, 0.0, 0.0, 0.0, 0.0},
                                      {0.0, 0.5, 0.0, 0.0, 0.0},
                                      {1e-3, 10.0, 0.0, 0.0, 0.0},
                                      {0.5, 0.2, 0.9, 0.0, 0.0},
                                      {0.2, 0.3, -0.5, 0.3, -0.2}})
        for (const double z : {1.0, 0.6, 0.3})
            for (const smx_grade grade : {SMX_GRADE_PRECISE, SMX_GRADE_FAST})
                EXPECT_GT(p_value_of(0.05, x, view_at(z, 2.0), grade, ++seed), significance / number_of_tests)
                    << "X " << x.alpha_x << " " << x.alpha_y << " " << x.rho << ", cosine " << z << ", grade " << grade;
    if (!test::has_double()) GTEST_SKIP() << "no doubles on this device";
    EXPECT_GT(p_value_of(0.05, {0.3, 0.1, 0.5, 0.1, 0.0}, view_at(0.5, 1.0), SMX_GRADE_DOUBLE, ++seed),
              significance / number_of_tests);
}

// The numbers themselves come back as shares: what cl/visible_normals.clh promises, and the rounding of normals.
TEST(Drawn, SlopesInvertTheirShares) {
    const std::vector<float> u = independent_numbers(3);
    for (const auto &[grade, error] : {std::pair{SMX_GRADE_PRECISE, 1e-6}, {SMX_GRADE_FAST, 2e-4}})
        for (const double z : {1.0, 0.999, 0.9, 0.5, 0.2, 0.05, 1e-3, 1e-6}) {
            const Vec view = view_at(z, 0.7);
            const Vec wo = {double{static_cast<float>(view.x)}, double{static_cast<float>(view.y)},
                            double{static_cast<float>(view.z)}};
            const std::vector<float> m = drawn_normals(1.0, {0.0, 0.0, 0.0, 0.0, 0.0}, wo, grade, u);
            const VisibleSlopes slopes(test::gaussian({1.0, 1.0, 0.0, 0.0, 0.0}), wo);
            double worst = 0.0;
            for (std::size_t k = 0; k < drawn; ++k) {
                const auto [along, across] = slopes.shares({m[3 * k], m[3 * k + 1], m[3 * k + 2]});
                worst = std::max({worst, std::abs(along - u[3 * k + 1]), std::abs(across - u[3 * k + 2])});
            }
            EXPECT_LT(worst, error) << "cosine of wo " << z << ", grade " << grade;
        }
}

namespace {

// Share of what a mixture draws in each cell of its widest lobe: the ratio of densities, over each cell's area.
std::vector<double> cells_of_mixture(const std::vector<Lobe> &lobes, const std::vector<double> &shares,
                                     const oracle::Gaussian &x, const Vec &wo) {
    // In the microsurface's own terms: a facet's density over slopes is (p - slope . wo_t) p22 / sigma.
    const oracle::Gaussian widest = oracle::widened(x, lobes.back().alpha);
    const VisibleSlopes slopes(widest, wo);
    std::vector<double> sums(side * side);
    const int fine = 1000;
    const double reach = 6.0;
    for (int i = 0; i < fine; ++i)
        for (int j = 0; j < fine; ++j) {
            const double t1 = reach * (2.0 * (i + 0.5) / fine - 1.0), t2 = reach * (2.0 * (j + 0.5) / fine - 1.0);
            const double sx = slopes.mean_x + slopes.a * t1, sy = slopes.mean_y + slopes.b * t1 + slopes.c * t2;
            const double seen = wo.z - wo.x * sx - wo.y * sy;
            if (seen <= 0.0) continue;
            double density = 0.0;
            for (std::size_t k = 0; k < lobes.size(); ++k) {
                const oracle::Gaussian lobe = oracle::widened(x, lobes[k].alpha);
                density += shares[k] * seen * oracle::p22(lobe, sx, sy) / oracle::sigma(lobe, wo);
            }
            const auto [u, v] = slopes.shares(oracle::normalised({-sx, -sy, 1.0}));
            const auto index = [](double s) { return std::min(static_cast<std::size_t>(s * side), side - 1); };
            sums[index(u) * side + index(v)] += density;
        }
    const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
    for (double &s : sums) s /= all;
    return sums;
}

// By what wo sees of each lobe; of the per-lobe model by luminance, here of curves that are constants.
std::vector<double> shares_of(const std::vector<Lobe> &lobes, smx_model model, const std::vector<double> &levels,
                              const oracle::Gaussian &x, const Vec &wo) {
    std::vector<double> shares;
    for (std::size_t k = 0; k < lobes.size(); ++k)
        shares.push_back(model == SMX_MODEL_SHARED
                             ? lobes[k].weight * oracle::sigma(oracle::widened(x, lobes[k].alpha), wo)
                             : levels[k]);
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double &s : shares) s /= sum;
    return shares;
}

} // namespace

TEST(Drawn, LobesHaveTheirShares) {
    const std::vector<Lobe> lobes = {{0.5, 0.15}, {0.3, 0.4}, {0.2, 0.8}};
    const std::vector<double> levels = {0.2, 0.7, 0.1};
    std::vector<test::Colour> colours;
    for (const double f : levels) colours.push_back({f, f, f});
    const smx_displacement x = {0.2, 0.1, 0.3, 0.0, 0.0};
    uint64_t seed = 200;
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        for (const double z : {0.9, 0.2}) {
            const Vec wo = view_at(z, 4.0);
            const test::Material material =
                model == SMX_MODEL_SHARED ? test::make_material(lobes) : test::make_per_lobe_material(lobes, colours);
            const Draws d = draw(make_evaluator(material, x), wo, independent_numbers(++seed));
            const oracle::Gaussian g = test::gaussian(x);
            const VisibleSlopes slopes(oracle::widened(g, lobes.back().alpha), wo);
            Cells cells;
            for (std::size_t k = 0; k < drawn; ++k) cells.add(slopes.shares(half(d.at(k), wo)));
            const std::vector<double> expected = cells_of_mixture(lobes, shares_of(lobes, model, levels, g, wo), g, wo);
            EXPECT_GT(cells.p_value(expected), significance / number_of_tests) << "model " << model << ", cosine " << z;
            // And not if the lobes had others.
            EXPECT_LT(cells.p_value(cells_of_mixture(lobes, {0.4, 0.4, 0.2}, g, wo)), 1e-6);
        }
}

namespace {

// Largest f cos / pdf over the channels, in units of the bound.
double largest_weight(const Evaluator &e, const Draws &d) {
    double bound = 0.0, most = 0.0;
    EXPECT_SMX_OK(smx_evaluator_sample_bound(e, &bound));
    for (std::size_t k = 0; k < d.pdf.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::isfinite(d.fcos[3 * k + c])) << k;
            EXPECT_TRUE(d.pdf[k] > 0.0f || d.fcos[3 * k + c] == 0.0f) << k;
            if (d.pdf[k] > 0.0f) most = std::max(most, double{d.fcos[3 * k + c]} / d.pdf[k] / bound);
        }
    return most;
}

// Curves that rise to grazing, or are 1.
test::Material material_with_curves(smx_model model, const std::vector<Lobe> &lobes, bool rise) {
    const std::size_t knots = 31, sets = model == SMX_MODEL_SHARED ? 1 : lobes.size();
    std::vector<double> curves;
    for (std::size_t s = 0; s < sets; ++s)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < knots; ++k)
                curves.push_back(
                    rise ? 0.02 * static_cast<double>(1 + s * c) + std::pow(static_cast<double>(k) / 30.0, 5.0) : 1.0);
    return test::make_material(model, lobes, curves, knots);
}

} // namespace

// With curves of 1 the bound is nearly reached, to what float32 leaves of it: 1e-3 where a direction's rounding moves a
// sharp lobe's density.
TEST(Drawn, WeightsAreBounded) {
    const std::vector<float> u = independent_numbers(7);
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        for (const std::vector<Lobe> &lobes :
             {std::vector<Lobe>{{1.0, 1e-4}}, {{0.5, 1e-3}, {0.5, 1.0}}, {{0.3, 0.1}, {0.3, 0.3}, {0.4, 30.0}}})
            for (const smx_displacement &x : {smx_displacement{0.0, 0.0, 0.0, 0.0, 0.0}, {0.5, 0.1, 0.5, 0.1, 0.2}})
                for (const double z : {1.0, 0.5, 0.25})
                    for (const bool rise : {false, true}) {
                        const test::Material material = material_with_curves(model, lobes, rise);
                        const Evaluator e = make_evaluator(material, x);
                        const double most = largest_weight(e, draw(e, view_at(z, 1.0), u));
                        EXPECT_LT(most, 1.001) << "model " << model << ", first alpha " << lobes[0].alpha << ", X "
                                               << x.alpha_x << ", cosine " << z;
                        EXPECT_GT(most, rise ? 0.001 : 0.9);
                    }
}

// Orders above 0 draw in closed form and evaluate by nodes: no bound is known, and what docs/packed-material.md states
// is measured here.
TEST(Drawn, WeightsOfOrdersAreMeasured) {
    const std::vector<float> u = independent_numbers(8);
    double most = 0.0;
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        for (const double alpha : {0.1, 0.25, 0.5})
            for (const double z : {1.0, 0.5, 0.1})
                for (const int32_t order : {1, 2, 3, 5, 8}) {
                    const test::Material material = material_with_curves(model, {{0.5, 0.05}, {0.5, 0.3}}, true);
                    const Evaluator e =
                        make_evaluator(material, {alpha, alpha, 0.0, 0.0, 0.0}, SMX_GRADE_PRECISE, order);
                    const double here = largest_weight(e, draw(e, view_at(z, 1.0), u));
                    std::printf(
                        "model %d, X's alpha %.2f, cosine of wo %.1f, order %d: %.3g of the closed form's bound\n",
                        model, alpha, z, order, here);
                    most = std::max(most, here);
                }
    EXPECT_LT(most, 10.0);
    EXPECT_GT(most, 0.1);
}

TEST(Drawn, EndsOfTheUniformNumbersAreFinite) {
    const float most = 1.0f - 0x1p-24f;
    std::vector<float> u;
    for (const float a : {0.0f, 0.5f, most})
        for (const float b : {0.0f, 0x1p-24f, 0.5f, most})
            for (const float c : {0.0f, 0x1p-24f, 0.5f, most}) u.insert(u.end(), {a, b, c});
    for (const double alpha : {1e-4, 0.3, 1e4})
        for (const double z : {1.0, 0.5, 1e-3, 1e-7, 1e-30}) {
            const test::Material material = test::make_material({{0.5, alpha}, {0.5, 2e-4}});
            const Evaluator e = make_evaluator(material, {0.0, 0.0, 0.0, 0.0, 0.0});
            const Draws d = draw(e, view_at(z, 0.0), u);
            for (std::size_t k = 0; k < d.pdf.size(); ++k) {
                const Vec wi = d.at(k);
                EXPECT_NEAR(oracle::dot(wi, wi), 1.0, 1e-5) << "alpha " << alpha << ", cosine " << z << ", draw " << k;
                EXPECT_TRUE(std::isfinite(d.pdf[k]) && d.pdf[k] >= 0.0f);
                for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(d.fcos[3 * k + c]));
            }
        }
}
