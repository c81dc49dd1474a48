// smx_brdf_eval against the oracle's lookup: on the nodes, at random directions, and where lookups break: near the
// mirror direction, at grazing, at wi = wo, below the horizon.
#include <gtest/gtest.h>

#include "close.h"
#include "directions.h"
#include "random.h"
#include "support.h"

using oracle::Lookup;
using oracle::Rgb;
using oracle::Table;
using oracle::Vec;
using test::Directions;

namespace {

// Float32: the angles are good to about 1e-7 relative, which is 2e-5 of a cell at the end of an axis of 90 or 180.
constexpr double table_tolerance = 2e-5;
// A table without any pattern changes tenfold within a cell.
constexpr double random_table_tolerance = 1e-4;
// Directions of a node, rounded to float32, lie 1e-7 / cos(theta_d) from it; in cells of phi_d, that over theta_h.
constexpr double node_tolerance = 1e-3;

// Values without any pattern, so that every wrong node shows.
Table random_table(int phi_d) {
    Table table;
    table.phi_d = phi_d;
    table.values.resize(3 * table.cells());
    test::Random random(11);
    for (double &value : table.values) value = random.uniform(0.1, 1.0);
    return table;
}

// Smooth and the same for wi and wo exchanged: theta_d = 0 and theta_h = 0 have one value, whatever the azimuth.
Table smooth_table() {
    return oracle::make_table(180, [](const Vec &wi, const Vec &wo) {
        const oracle::HalfDiff a = oracle::half_diff(wi, wo, {0.0, 0.0, 1.0});
        const double wave = std::sin(a.theta_h) * std::sin(a.theta_d) * std::cos(2.0 * a.phi_d);
        return Rgb{2.0 + wave, 3.0 - wave, std::exp(-30.0 * a.theta_h)};
    });
}

// The table is periodic modulo pi; one over the full azimuth counts with the mean of its halves.
Rgb expected(const Table &table, Lookup how, const Vec &wi, const Vec &wo) {
    if (wi.z <= 0.0 || wo.z <= 0.0) return {};
    oracle::HalfDiff at = oracle::half_diff(wi, wo, {0.0, 0.0, 1.0});
    Rgb value = oracle::lookup(table, how, at);
    if (table.phi_d == 360) {
        at.phi_d += oracle::pi;
        const Rgb other = oracle::lookup(table, how, at);
        for (std::size_t c = 0; c < 3; ++c) value[c] = (value[c] + other[c]) / 2.0;
    }
    return value;
}

smx_lookup to_api(Lookup how) { return how == Lookup::linear ? SMX_LOOKUP_LINEAR : SMX_LOOKUP_NEAREST; }

std::vector<float> eval(smx_brdf brdf, Lookup how, const Directions &d) {
    std::vector<float> f(3 * d.count(), -1.0f);
    EXPECT_SMX_OK(smx_brdf_eval(test::context(), brdf, to_api(how), d.count(), d.wi.data(), d.wo.data(), f.data()));
    return f;
}

void expect_oracle(smx_brdf brdf, Lookup how, const Directions &d, double tolerance = table_tolerance) {
    const Table table = test::filled_table(brdf);
    const std::vector<float> f = eval(brdf, how, d);
    for (std::size_t k = 0; k < d.count(); ++k) {
        const Vec wi = Directions::at(d.wi, k), wo = Directions::at(d.wo, k);
        const Rgb wanted = expected(table, how, wi, wo);
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_TRUE(test::is_close(f[3 * k + c], wanted[c], tolerance, 0.0))
                << "wi (" << wi.x << ", " << wi.y << ", " << wi.z << "), wo (" << wo.x << ", " << wo.y << ", " << wo.z
                << "), channel " << c << ": " << f[3 * k + c] << ", wanted " << wanted[c];
    }
}

double in_cell(double at) { return std::abs(at - std::round(at)); }

// Nearest jumps at the borders of cells: directions within float's reach of one have two right answers.
bool inside_a_cell(const Vec &wi, const Vec &wo) {
    const oracle::HalfDiff a = oracle::half_diff(wi, wo, {0.0, 0.0, 1.0});
    const double degree = oracle::pi / 180.0;
    return in_cell(90.0 * std::sqrt(a.theta_h / (oracle::pi / 2.0))) > 1e-3 && in_cell(a.theta_d / degree) > 1e-3 &&
           in_cell(a.phi_d / degree) > 1e-3;
}

Directions random_directions() {
    test::Random random(12);
    Directions d;
    while (d.count() < 20000) {
        const Vec wi = random.direction(), wo = random.direction();
        if (inside_a_cell(wi, wo)) d.add(wi, wo);
    }
    return d;
}

} // namespace

TEST(EvalTable, Nodes) {
    const Table table = random_table(180);
    const test::Brdf brdf = test::make_brdf(table);
    Directions d;
    std::vector<std::size_t> cells;
    for (int th = 8; th < 90; th += 3)
        for (int td = 1; td < 80; td += 4)
            for (int pd = 0; pd < 180; pd += 7) {
                const oracle::Pair pair = oracle::node_directions(th, td, pd);
                if (pair.wi.z <= 1e-6 || pair.wo.z <= 1e-6) continue;
                d.add(pair.wi, pair.wo);
                cells.push_back(table.index(th, td, pd));
            }
    ASSERT_GT(cells.size(), 5000u);
    const std::vector<float> f = eval(brdf, Lookup::linear, d);
    for (std::size_t k = 0; k < cells.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(f[3 * k + c], table.values[c * table.cells() + cells[k]], node_tolerance)
                << "node " << cells[k];
}

TEST(EvalTable, RandomDirections) {
    const Directions d = random_directions();
    for (const int phi_d : {180, 360}) {
        const test::Brdf brdf = test::make_brdf(random_table(phi_d));
        for (const Lookup how : {Lookup::linear, Lookup::nearest}) {
            if (phi_d == 360 && how == Lookup::nearest) continue; // the oracle's nearest knows one half
            SCOPED_TRACE(testing::Message() << phi_d << (how == Lookup::linear ? " linear" : " nearest"));
            expect_oracle(brdf, how, d, random_table_tolerance);
        }
    }
}

// The peak of a mirror-like table lies in cells of 1e-4 radian: a cosine's arc would miss them.
TEST(EvalTable, MirrorDirections) {
    const test::Brdf brdf = test::make_brdf(smooth_table());
    test::Random random(13);
    Directions d;
    for (int k = 0; k < 3000; ++k) {
        const double slope = random.log_uniform(1e-6, 0.1), phi = random.uniform(0.0, 2.0 * oracle::pi);
        const Vec wi = random.direction(0.2);
        const Vec wo = oracle::reflect(wi, oracle::normalised({slope * std::cos(phi), slope * std::sin(phi), 1.0}));
        if (wo.z > 1e-3) d.add(wi, wo);
    }
    d.add({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
    expect_oracle(brdf, Lookup::linear, d);
}

TEST(EvalTable, GrazingAndRetroReflection) {
    const test::Brdf brdf = test::make_brdf(smooth_table());
    Directions d;
    std::vector<Vec> list;
    for (const double z : {1.0, 0.999, 0.5, 0.1, 1e-3, 1e-5})
        for (const double phi : {0.0, 0.3, oracle::pi / 2.0, 3.0, 5.0}) {
            const double r = std::sqrt(1.0 - z * z);
            list.push_back({r * std::cos(phi), r * std::sin(phi), z});
        }
    for (const Vec &wi : list)
        for (const Vec &wo : list) d.add(wi, wo);
    expect_oracle(brdf, Lookup::linear, d);
}

// In the last cells of theta_h and theta_d linear keeps the last node's value, nearest takes the cell as any other.
TEST(EvalTable, PastTheLastNodes) {
    const test::Brdf brdf = test::make_brdf(random_table(180));
    Directions d;
    for (const double phi_d : {89.5, 90.5}) {
        const double phi = test::radians(phi_d);
        const oracle::Pair h = oracle::directions(1.555, test::radians(20.5), phi);
        const oracle::Pair t = oracle::directions(0.3, test::radians(89.5), phi);
        d.add(h.wi, h.wo);
        d.add(t.wi, t.wo);
        ASSERT_TRUE(h.wi.z > 0.0 && h.wo.z > 0.0 && t.wi.z > 0.0 && t.wo.z > 0.0);
    }
    for (const Lookup how : {Lookup::linear, Lookup::nearest}) expect_oracle(brdf, how, d, random_table_tolerance);
}

TEST(EvalTable, FIsNotTimesACosineAndIsReciprocal) {
    std::vector<double> constant(std::size_t{3} * 90 * 90 * 180, 0.25);
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_create("constant", 180, constant.data(), brdf.out()));
    Directions d;
    test::Random random(14);
    for (int k = 0; k < 500; ++k) d.add(random.direction(), random.direction());
    for (const Lookup how : {Lookup::linear, Lookup::nearest})
        for (const float f : eval(brdf, how, d)) ASSERT_FLOAT_EQ(f, 0.25f);

    const test::Brdf uneven = test::make_brdf(random_table(180));
    Directions exchanged{d.wo, d.wi};
    const std::vector<float> there = eval(uneven, Lookup::linear, d), back = eval(uneven, Lookup::linear, exchanged);
    for (std::size_t k = 0; k < there.size(); ++k)
        ASSERT_TRUE(test::is_close(there[k], back[k], random_table_tolerance, 0.0));
}

TEST(EvalTable, BelowTheHorizonIsZero) {
    const test::Brdf brdf = test::make_brdf(random_table(180));
    Directions d;
    const Vec up{0.0, 0.0, 1.0}, down{0.0, 0.0, -1.0}, edge{1.0, 0.0, 0.0}, under{0.8, 0.0, -0.6};
    for (const Vec &k : {down, edge, under}) {
        d.add(k, up);
        d.add(up, k);
        d.add(k, k);
    }
    d.add(edge, {-1.0, 0.0, 0.0});
    for (const Lookup how : {Lookup::linear, Lookup::nearest})
        for (const float f : eval(brdf, how, d)) EXPECT_EQ(f, 0.0f);
}

TEST(EvalTable, WritesExactlyItsResults) {
    const test::Brdf brdf = test::make_brdf(random_table(180));
    test::Random random(15);
    for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{93}, std::size_t{257 * 89}}) {
        Directions d;
        for (std::size_t k = 0; k < count; ++k) d.add(random.direction(0.1), random.direction(0.1));
        constexpr float canary = -12345.0f;
        std::vector<float> f(3 * count + 64, canary);
        ASSERT_SMX_OK(
            smx_brdf_eval(test::context(), brdf, SMX_LOOKUP_LINEAR, count, d.wi.data(), d.wo.data(), f.data()));
        for (std::size_t k = 0; k < f.size(); ++k) ASSERT_EQ(f[k] == canary, k >= 3 * count) << k << " of " << count;
    }
}

TEST(EvalTable, EveryVectorWidth) {
    const test::Brdf brdf = test::make_brdf(random_table(180));
    const Directions d = random_directions();
    const std::vector<float> wanted = eval(brdf, Lookup::linear, d);
    for (const std::uint32_t width : {1u, 4u, 8u, 16u}) {
        smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
        options.vector_width = width;
        test::Context context;
        ASSERT_SMX_OK(smx_context_create(&options, context.out()));
        std::vector<float> f(3 * d.count());
        ASSERT_SMX_OK(smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, d.count(), d.wi.data(), d.wo.data(), f.data()));
        for (std::size_t k = 0; k < f.size(); ++k)
            ASSERT_TRUE(test::is_close(f[k], wanted[k], random_table_tolerance, 0.0)) << width << " lanes, value " << k;
    }
}
