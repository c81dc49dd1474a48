// Pixels of the reference against the oracle's converged integral.
#include <gtest/gtest.h>

#include "close.h"
#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "support.h"

using oracle::Integral;
using oracle::Lookup;
using oracle::Masking;
using oracle::Table;

namespace {

// The accuracy asked of the reference. The oracle's own error is asserted to be a tenth of it.
constexpr double pixel_tolerance = 0.01;
constexpr double oracle_error = 0.001;
// Pixels darker than this share of the brightest look into X's tail, where the grid's strata are as wide as the lobe:
// at 1024 x 1024 samples their noise is up to 6e-4 of the brightest. test_statistics shows that it is only noise.
constexpr double dark_share = 0.1;
// Below this float32 is denormal.
constexpr double black = 1e-35;

struct Setting {
    const char *name;
    smx_displacement x;
    double light_deg;
    smx_masking masking;
};

const std::vector<Setting> &settings() {
    static const std::vector<Setting> list{
        {"isotropic 0.25, camera", {0.25, 0.25, 0.0, 0.0, 0.0}, 90.0, SMX_G2_CORRELATED},
        {"isotropic 0.5, right", {0.5, 0.5, 0.0, 0.0, 0.0}, 0.0, SMX_G2_CORRELATED},
        {"isotropic 0.1, behind", {0.1, 0.1, 0.0, 0.0, 0.0}, -25.0, SMX_G2_CORRELATED},
        {"latitudinal 0.25", {0.25, 0.0, 0.0, 0.0, 0.0}, 40.0, SMX_G2_CORRELATED},
        {"longitudinal 0.5", {0.0, 0.5, 0.0, 0.0, 0.0}, 0.0, SMX_G2_CORRELATED},
        {"correlated slopes", {0.6, 0.4, 0.7, 0.0, 0.0}, 40.0, SMX_G2_CORRELATED},
        {"mean slope", {0.25, 0.25, 0.0, 0.3, -0.2}, 40.0, SMX_G2_CORRELATED},
        {"mean slope on a line", {0.0, 0.3, 0.0, 0.1, 0.2}, 40.0, SMX_G2_CORRELATED},
        {"mean slope alone", {0.0, 0.0, 0.0, 0.2, 0.1}, 40.0, SMX_G2_CORRELATED},
        {"separable", {0.5, 0.5, 0.0, 0.0, 0.0}, -25.0, SMX_G2_SEPARABLE},
    };
    return list;
}

struct Sampling {
    const char *name;
    smx_sampler sampler;
    uint32_t spp;
};

// As many samples as the tolerance needs: the grid most, facets of the base itself least.
constexpr Sampling grid{"grid", SMX_SAMPLER_GRID, 1024 * 1024}, sobol{"sobol", SMX_SAMPLER_SOBOL, 1 << 19},
    mis{"mis", SMX_SAMPLER_MIS, 1 << 17};

constexpr uint32_t resolution = 9;

double brightest(const test::Pixels &pixels) {
    double peak = 0.0;
    for (std::size_t k = 0; k < std::size_t{4} * resolution * resolution; ++k)
        if (k % 4 != 3) peak = std::max(peak, static_cast<double>(pixels.rgba[k]));
    return peak;
}

struct Expected {
    uint32_t column, row;
    Integral integral;
};

// The integral at every fifth pixel that is on the sphere.
std::vector<Expected> expected(const Table &table, const Setting &s) {
    const oracle::FacetBrdf f = oracle::table_brdf(table, Lookup::linear);
    std::vector<Expected> list;
    for (uint32_t k = 2; k < resolution * resolution; k += 5) {
        const uint32_t column = k % resolution, row = k / resolution;
        const oracle::Pixel p = oracle::sphere_pixel(resolution, resolution, column, row, test::radians(s.light_deg));
        if (!p.on_sphere) continue;
        list.push_back({column, row, oracle::reference(f, test::masking(s.masking), test::gaussian(s.x), p.wi, p.wo)});
    }
    return list;
}

void expect_image(smx_brdf brdf, const Setting &s, const Sampling &sampling, const std::vector<Expected> &wanted) {
    const smx_scene scene = test::make_scene(resolution, resolution, test::radians(s.light_deg), s.x, s.masking);
    smx_render_options options = test::make_options(sampling.spp);
    options.sampler = sampling.sampler;
    const test::Image image = test::render_reference(brdf, scene, options);
    const test::Pixels pixels = test::pixels(image);
    const double floor = pixel_tolerance * dark_share * brightest(pixels) + black;
    for (const Expected &e : wanted)
        for (std::size_t c = 0; c < 3; ++c) {
            const double got = pixels.at(e.column, e.row)[c], value = e.integral.rgb[c];
            if (value > floor) {
                EXPECT_LT(e.integral.error, oracle_error) << s.name;
            }
            EXPECT_TRUE(test::is_close(got, value, pixel_tolerance, floor))
                << s.name << ", " << sampling.name << ", pixel " << e.column << " " << e.row << ", channel " << c
                << ": got " << got << ", wanted " << value << " (relative error " << got / value - 1.0
                << ", the oracle's " << e.integral.error << ", floor " << floor << ")";
        }
}

void expect_integral_everywhere(smx_brdf brdf, const std::vector<Sampling> &samplings) {
    const Table table = test::filled_table(brdf);
    for (const Setting &s : settings()) {
        const std::vector<Expected> wanted = expected(table, s);
        for (const Sampling &sampling : samplings) expect_image(brdf, s, sampling, wanted);
    }
}

} // namespace

TEST(Reference, BeckmannBase) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.05}}, Masking::correlated));
    expect_integral_everywhere(brdf, {grid, sobol, mis});
}

TEST(Reference, TwoLobes) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{0.2, 0.02}, {0.8, 0.4}}, Masking::correlated));
    expect_integral_everywhere(brdf, {grid, mis});
}

TEST(Reference, BuiltinTwoLayer) {
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:two-layer", brdf.out()));
    expect_integral_everywhere(brdf, {grid, mis});
}

// Ten times sharper than the grid could resolve.
TEST(Reference, MirrorLikeBase) {
    expect_integral_everywhere(test::make_brdf(test::beckmann_table({{1.0, 0.004}}, Masking::correlated)), {mis});
}

// The integral itself moves by more than the tolerance when masking, mean slope or axes are wrong.
TEST(Reference, ToleranceSeesWrongFormulas) {
    const Table table = test::filled_table(test::make_brdf(test::beckmann_table({{1.0, 0.3}}, Masking::correlated)));
    const oracle::FacetBrdf f = oracle::table_brdf(table, Lookup::linear);
    // Light and view both graze, so that every part of the masking matters.
    const oracle::Pixel p = oracle::sphere_pixel(9, 9, 6, 0, test::radians(-60.0));
    const auto value = [&](Masking g, const smx_displacement &x) {
        return oracle::reference(f, g, test::gaussian(x), p.wi, p.wo).rgb[0];
    };
    const double right = value(Masking::correlated, {0.5, 0.25, 0.0, 0.1, 0.0});
    ASSERT_GT(right, 0.0);
    for (const double wrong : {value(Masking::coinciding, {0.5, 0.25, 0.0, 0.1, 0.0}),
                               value(Masking::correlated, {0.25, 0.5, 0.0, 0.1, 0.0}),
                               value(Masking::correlated, {0.5, 0.25, 0.0, -0.1, 0.0}),
                               value(Masking::correlated, {0.5, 0.25, 0.5, 0.1, 0.0})})
        EXPECT_FALSE(test::is_close(wrong, right, pixel_tolerance, 0.0)) << wrong << " against " << right;
}

// mis fits its proposal to the table at the image's theta_d, where there may be nothing to fit.
TEST(Reference, IsBlackWhereTheTableIs) {
    oracle::Table table = test::beckmann_table({{1.0, 0.1}}, Masking::correlated);
    for (int channel = 0; channel < 3; ++channel)
        for (int th = 0; th < 90; ++th)
            for (int td = 40; td < 90; ++td)
                for (int pd = 0; pd < table.phi_d; ++pd)
                    table.values[static_cast<std::size_t>(channel) * table.cells() + table.index(th, td, pd)] = 0.0;
    const test::Brdf brdf = test::make_brdf(table);
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.spp = 256;
    for (const double light : {0.0, 90.0}) { // theta_d 45 degrees, and 0
        const smx_scene scene = test::make_scene(16, 16, test::radians(light), {0.3, 0.3, 0.0, 0.0, 0.0});
        const test::Image image = test::render_reference(brdf, scene, options);
        double highest = -1.0;
        ASSERT_SMX_OK(smx_image_quantile(image, 1.0, &highest));
        if (light == 0.0)
            EXPECT_EQ(highest, 0.0);
        else
            EXPECT_GT(highest, 0.1);
    }
}
