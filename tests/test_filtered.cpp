// Filtered images: every pixel is the oracle's shading at the pixel's directions, and the filter is the reference
// where its approximation is good.
#include <gtest/gtest.h>

#include "close.h"
#include "oracle_sphere.h"
#include "support.h"

using oracle::Lobe;
using oracle::Masking;
using oracle::Mixture;

namespace {

// Float32 shading of directions that float32 made from the pixel's position.
constexpr double pixel_tolerance = 5e-5;
constexpr double pixel_floor = 1e-9;
// The figure asked of the filter on a base of alpha 0.05 under r = 0.05.
constexpr double filter_tolerance = 0.005;

const std::vector<smx_displacement> &displacements() {
    static const std::vector<smx_displacement> list{
        {0.0, 0.0, 0.0, 0.0, 0.0}, {0.25, 0.25, 0.0, 0.0, 0.0}, {0.5, 0.0, 0.0, 0.0, 0.0},
        {0.0, 0.5, 0.0, 0.0, 0.0}, {0.3, 0.2, 0.7, 0.0, 0.0},   {0.2, 0.2, 0.0, 0.3, -0.2},
    };
    return list;
}

double shading(const Mixture &m, smx_masking g, const smx_scene &s, double column_shift, double row_shift, int column,
               int row) {
    const oracle::Pixel p = oracle::sphere_pixel(static_cast<int>(s.width), static_cast<int>(s.height),
                                                 column + column_shift, row + row_shift, s.light_phi);
    return p.on_sphere ? oracle::fcos(m, test::masking(g), p.wi, p.wo) : 0.0;
}

// How much a pixel changes when its centre moves by the roundings of float32: large at the silhouette.
double sensitivity(const Mixture &m, const smx_scene &s, int column, int row) {
    const double step = 1e-7 * s.width, here = shading(m, s.masking, s, 0.0, 0.0, column, row);
    return std::abs(shading(m, s.masking, s, step, 0.0, column, row) - here) +
           std::abs(shading(m, s.masking, s, 0.0, step, column, row) - here) +
           std::abs(shading(m, s.masking, s, -step, 0.0, column, row) - here) +
           std::abs(shading(m, s.masking, s, 0.0, -step, column, row) - here);
}

void expect_oracle_image(const std::vector<Lobe> &lobes, const smx_scene &scene) {
    const test::Image image = test::render_filtered(test::make_material(lobes, test::channel_fresnel), scene);
    const test::Pixels pixels = test::pixels(image);
    const Mixture m{lobes, test::gaussian(scene.displacement)};
    for (int row = 0; row < static_cast<int>(scene.height); ++row)
        for (int column = 0; column < static_cast<int>(scene.width); ++column) {
            const double wanted = shading(m, scene.masking, scene, 0.0, 0.0, column, row);
            const double floor = pixel_floor + sensitivity(m, scene, column, row);
            for (std::size_t c = 0; c < 3; ++c) {
                const double got = pixels.at(static_cast<uint32_t>(column), static_cast<uint32_t>(row))[c];
                ASSERT_TRUE(test::is_close(got, test::channel_fresnel[c] * wanted, pixel_tolerance, floor))
                    << "pixel " << column << " " << row << " of " << scene.width << "x" << scene.height << ", light "
                    << scene.light_phi << ", X " << scene.displacement.alpha_x << " " << scene.displacement.alpha_y
                    << ", channel " << c << ": got " << got << ", wanted " << test::channel_fresnel[c] * wanted
                    << ", floor " << floor;
            }
        }
}

} // namespace

TEST(Filtered, PixelsAreTheOracles) {
    for (const smx_displacement &x : displacements())
        for (const double light : {90.0, 0.0, -25.0, 40.0})
            for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE})
                expect_oracle_image({{0.3, 0.05}, {0.7, 0.4}}, test::make_scene(33, 33, test::radians(light), x, g));
}

TEST(Filtered, SphereFillsTheSmallerSide) {
    for (const auto &[width, height] : {std::pair{64u, 31u}, {31u, 64u}, {7u, 1u}, {1u, 1u}, {2u, 2u}})
        expect_oracle_image({{1.0, 0.3}}, test::make_scene(width, height, test::radians(40.0), displacements()[1]));
}

// Base and X of 0.05 each. The table is read by linear interpolation; the material has the true lobe.
TEST(Filtered, IsTheReferenceForNarrowLobes) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.05}}, Masking::correlated));
    const test::Material material = test::make_material({{1.0, 0.05}}, test::channel_fresnel);
    for (const double light : {90.0, 0.0, -25.0}) {
        const smx_scene scene = test::make_scene(128, 128, test::radians(light), {0.05, 0.05, 0.0, 0.0, 0.0});
        const test::Image reference = test::render_reference(brdf, scene, test::make_options(64 * 64));
        EXPECT_LT(test::relrmse(test::render_filtered(material, scene), reference), filter_tolerance)
            << "light " << light;
        // The measure sees a lobe whose alpha is 2 % off.
        const test::Material off = test::make_material({{1.0, 0.051}}, test::channel_fresnel);
        EXPECT_GT(test::relrmse(test::render_filtered(off, scene), reference), filter_tolerance) << "light " << light;
    }
}

// The same from end to end: the material comes from the table by inversion and fit.
TEST(Filtered, FitOfATableIsItsReference) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.05}}, Masking::correlated));
    const test::Material material = test::fit(test::make_density(brdf, SMX_MASKING_CORRELATED), 1);
    const smx_scene scene = test::make_scene(128, 128, test::radians(90.0), {0.05, 0.05, 0.0, 0.0, 0.0});
    const test::Image reference = test::render_reference(brdf, scene, test::make_options(64 * 64));
    EXPECT_LT(test::relrmse(test::render_filtered(material, scene), reference), 2.0 * filter_tolerance);
}
