// The reference without displacement is f cos of the table: one lookup a pixel, linear or nearest, for tables of random
// values, which show every wrong cell.
#include <gtest/gtest.h>

#include "close.h"
#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "random.h"
#include "support.h"

using oracle::HalfDiff;
using oracle::Lookup;
using oracle::Masking;
using oracle::Rgb;
using oracle::Table;
using oracle::Vec;

namespace {

constexpr Vec normal{0.0, 0.0, 1.0};
constexpr smx_displacement flat{0.0, 0.0, 0.0, 0.0, 0.0};
// Float32 angles: a cell of theta_h near 0 is 2e-4 rad wide, so shares between nodes are good to about 1e-3 there.
constexpr double random_table_tolerance = 5e-3;
constexpr double smooth_table_tolerance = 2e-4;
// Distance from a cell's border, in cells, where float32 may choose the neighbour.
constexpr double border = 2e-2;

// Every cell has a value of its own; the halves of a full azimuth are alike, as reciprocity has it.
Table random_table(int phi_d) {
    Table t;
    t.phi_d = phi_d;
    t.values.resize(3 * t.cells());
    test::Random random(19);
    for (double &v : t.values) v = random.uniform(0.2, 1.0);
    for (std::size_t k = 0; k < t.values.size(); ++k)
        if (k % static_cast<std::size_t>(phi_d) >= 180) t.values[k] = t.values[k - 180];
    return t;
}

// A table without sharp features, with a value of its own in every channel and direction.
Table smooth_table() {
    Table t;
    t.values.resize(3 * t.cells());
    for (int th = 0; th < 90; ++th)
        for (int td = 0; td < 90; ++td)
            for (int pd = 0; pd < 180; ++pd)
                for (std::size_t c = 0; c < 3; ++c) {
                    const double u = th / 90.0, v = td / 90.0;
                    t.values[c * t.cells() + t.index(th, td, pd)] =
                        static_cast<double>(c + 1) * (2.0 - u) * (1.0 + v) *
                        (1.0 + 0.2 * u * v * std::cos(2.0 * pd * oracle::pi / 180.0));
                }
    return t;
}

struct View {
    smx_scene scene;
    oracle::Pixel pixel;
    uint32_t column, row;
};

// All lit pixels of a scene that are not so close to the silhouette that float32 directions are uncertain.
std::vector<View> lit_pixels(const smx_scene &s) {
    std::vector<View> views;
    for (uint32_t row = 0; row < s.height; ++row)
        for (uint32_t column = 0; column < s.width; ++column) {
            const oracle::Pixel p =
                oracle::sphere_pixel(static_cast<int>(s.width), static_cast<int>(s.height), column, row, s.light_phi);
            if (p.on_sphere && p.wi.z > 1e-3 && p.edge_distance > 1e-3) views.push_back({s, p, column, row});
        }
    return views;
}

// The smallest and largest value that the nearest lookup can give when the coordinates move by `border` cells.
std::pair<Rgb, Rgb> nearest_range(const Table &table, const HalfDiff &at) {
    Rgb low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{};
    const double u = std::sqrt(at.theta_h / (oracle::pi / 2.0)), degree = oracle::pi / 180.0;
    for (int move = 0; move < 27; ++move) {
        const double mh = border * (move % 3 - 1), md = border * (move / 3 % 3 - 1), mp = border * (move / 9 - 1);
        const double moved_u = std::max(0.0, u + mh / 90.0);
        const HalfDiff moved{moved_u * moved_u * oracle::pi / 2.0, std::max(0.0, at.theta_d + md * degree),
                             std::remainder(at.phi_d + mp * degree, 2.0 * oracle::pi)};
        const Rgb value = oracle::lookup(table, Lookup::nearest, moved);
        for (std::size_t c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], value[c]);
            high[c] = std::max(high[c], value[c]);
        }
    }
    return {low, high};
}

test::Image lookup_image(const Table &table, const smx_scene &scene, smx_lookup lookup) {
    return test::render_reference(test::make_brdf(table), scene, test::make_options(1, 0, lookup));
}

} // namespace

TEST(ReferenceLimit, LinearLookupOfRandomTables) {
    for (const int phi_d : {180, 360}) {
        const Table table = random_table(phi_d);
        for (const double light : {0.0, -25.0, 40.0}) {
            const smx_scene scene = test::make_scene(65, 65, test::radians(light), flat);
            const test::Image image = lookup_image(table, scene, SMX_LOOKUP_LINEAR);
            const test::Pixels pixels = test::pixels(image);
            for (const View &v : lit_pixels(scene)) {
                const HalfDiff at = oracle::half_diff(v.pixel.wi, v.pixel.wo, normal);
                const Rgb f = oracle::lookup(table, Lookup::linear, at);
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_TRUE(
                        test::is_close(pixels.at(v.column, v.row)[c], f[c] * v.pixel.wi.z, random_table_tolerance, 0.0))
                        << "pixel " << v.column << " " << v.row << ", light " << light << ", phi_d cells " << phi_d
                        << ", theta_h " << at.theta_h << ", theta_d " << at.theta_d << ", phi_d " << at.phi_d
                        << ": got " << pixels.at(v.column, v.row)[c] << ", wanted " << f[c] * v.pixel.wi.z;
            }
        }
    }
}

TEST(ReferenceLimit, NearestLookupOfRandomTables) {
    const Table table = random_table(180);
    int unambiguous = 0;
    for (const double light : {15.0, -25.0, 41.0}) { // theta_d in the middle of a cell
        const smx_scene scene = test::make_scene(65, 65, test::radians(light), flat);
        const test::Image image = lookup_image(table, scene, SMX_LOOKUP_NEAREST);
        const test::Pixels pixels = test::pixels(image);
        for (const View &v : lit_pixels(scene)) {
            const HalfDiff at = oracle::half_diff(v.pixel.wi, v.pixel.wo, normal);
            const auto [low, high] = nearest_range(table, at);
            unambiguous += low == high;
            for (std::size_t c = 0; c < 3; ++c) {
                const double got = pixels.at(v.column, v.row)[c] / v.pixel.wi.z;
                ASSERT_TRUE(got >= low[c] * (1.0 - 1e-4) && got <= high[c] * (1.0 + 1e-4))
                    << "pixel " << v.column << " " << v.row << ", light " << light << ", theta_h " << at.theta_h
                    << ", theta_d " << at.theta_d << ", phi_d " << at.phi_d << ": got " << got << ", wanted " << low[c]
                    << " to " << high[c];
            }
        }
    }
    EXPECT_GT(unambiguous, 2000);
}

TEST(ReferenceLimit, SmoothTableEverywhere) {
    const Table table = smooth_table();
    for (const double light : {90.0, 0.0, -25.0, -80.0}) {
        const smx_scene scene = test::make_scene(65, 65, test::radians(light), flat);
        const test::Image image = lookup_image(table, scene, SMX_LOOKUP_LINEAR);
        const test::Pixels pixels = test::pixels(image);
        for (const View &v : lit_pixels(scene)) {
            const Rgb f = oracle::lookup(table, Lookup::linear, oracle::half_diff(v.pixel.wi, v.pixel.wo, normal));
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_TRUE(
                    test::is_close(pixels.at(v.column, v.row)[c], f[c] * v.pixel.wi.z, smooth_table_tolerance, 1e-6))
                    << "pixel " << v.column << " " << v.row << ", light " << light << ": got "
                    << pixels.at(v.column, v.row)[c] << ", wanted " << f[c] * v.pixel.wi.z;
        }
    }
}

// The lookups differ, so the tests above tell them apart; and a table read with phi_d mirrored is another table.
TEST(ReferenceLimit, RandomTablesTellLookupsApart) {
    const Table table = random_table(180);
    const HalfDiff at{0.5, 0.6, 0.7}, mirrored{0.5, 0.6, -0.7};
    const double linear = oracle::lookup(table, Lookup::linear, at)[0];
    EXPECT_FALSE(test::is_close(linear, oracle::lookup(table, Lookup::nearest, at)[0], random_table_tolerance, 0.0));
    EXPECT_FALSE(
        test::is_close(linear, oracle::lookup(table, Lookup::linear, mirrored)[0], random_table_tolerance, 0.0));
}

// A small X changes a smooth base by about its variance.
TEST(ReferenceLimit, SmallDisplacementIsContinuous) {
    const test::Brdf brdf = test::make_brdf(smooth_table());
    for (const smx_displacement &x :
         {smx_displacement{1e-4, 1e-4, 0.0, 0.0, 0.0}, {1e-4, 0.0, 0.0, 0.0, 0.0}, {0.0, 1e-4, 0.0, 0.0, 0.0}}) {
        const smx_scene still = test::make_scene(33, 33, test::radians(40.0), flat);
        const smx_scene moved = test::make_scene(33, 33, test::radians(40.0), x);
        const test::Image a = test::render_reference(brdf, moved, test::make_options(1024));
        const test::Image b = test::render_reference(brdf, still, test::make_options(1024));
        EXPECT_LT(test::relrmse(a, b), 1e-4) << "X " << x.alpha_x << " " << x.alpha_y;
    }
}
