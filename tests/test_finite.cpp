// No NaN, no infinity and nothing negative in any pixel of any image: all integrators, lights down to exactly behind,
// sizes with and without a middle pixel, displacements up to the extremes. Alpha is 1 on the surface and 0 off it: on
// the sphere, or, for the picture of the geometry, on the displaced sphere.
#include <gtest/gtest.h>

#include "oracle_sphere.h"
#include "support.h"

namespace {

// Where float32 may see a pixel's centre on the other side of the silhouette.
constexpr double silhouette = 1e-6;

const std::vector<smx_displacement> &displacements() {
    static const std::vector<smx_displacement> list{
        {0.0, 0.0, 0.0, 0.0, 0.0}, {0.25, 0.25, 0.0, 0.0, 0.0},    {0.5, 0.0, 0.0, 0.0, 0.0},
        {0.0, 0.1, 0.0, 0.0, 0.0}, {1e-4, 20.0, 0.0, 0.0, 0.0},    {1e-30, 1e-30, 0.0, 0.0, 0.0},
        {1e4, 1e4, 0.0, 0.0, 0.0}, {0.5, 0.5, 0.999999, 0.0, 0.0}, {0.3, 0.3, -0.9, 1.0, -2.0},
        {0.0, 0.0, 0.0, 1e4, 0.0}, {0.1, 0.0, 0.0, -1e4, 1e4},     {1e4, 0.0, 0.5, 3.0, 0.0},
    };
    return list;
}

constexpr double lights[] = {90.0, 0.0, -25.0, -90.0, 180.0, 0.001};
constexpr std::pair<uint32_t, uint32_t> sizes[] = {{1, 1}, {1, 7}, {2, 2}, {32, 32}, {93, 93}, {257, 89}};

enum class Surface { sphere, displaced };

void expect_sound(smx_image image, const smx_scene &s, Surface surface, const char *what) {
    const test::Pixels p = test::pixels(image);
    for (uint32_t row = 0; row < s.height; ++row)
        for (uint32_t column = 0; column < s.width; ++column) {
            const oracle::Pixel wanted =
                oracle::sphere_pixel(static_cast<int>(s.width), static_cast<int>(s.height), column, row, s.light_phi);
            const float *rgba = p.at(column, row);
            const bool known = surface == Surface::sphere && std::abs(wanted.edge_distance) >= silhouette;
            bool good = known ? rgba[3] == (wanted.on_sphere ? 1.0f : 0.0f) : rgba[3] == 0.0f || rgba[3] == 1.0f;
            for (int c = 0; c < 3; ++c)
                good = good && std::isfinite(rgba[c]) && rgba[c] >= 0.0f && (rgba[3] != 0.0f || rgba[c] == 0.0f);
            ASSERT_TRUE(good) << what << ", pixel " << column << " " << row << " of " << s.width << "x" << s.height
                              << ", light " << s.light_phi << ", X " << s.displacement.alpha_x << " "
                              << s.displacement.alpha_y << " rho " << s.displacement.rho << " mean "
                              << s.displacement.mean_slope_x << " " << s.displacement.mean_slope_y << ": " << rgba[0]
                              << " " << rgba[1] << " " << rgba[2] << " " << rgba[3];
        }
}

// Every `every`-th of the scenes.
template <class Render>
void for_all_scenes(const Render &render, Surface surface, const char *what, int every = 1) {
    int count = 0;
    for (const smx_displacement &x : displacements())
        for (const double light : lights)
            for (const auto &[width, height] : sizes)
                for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
                    if (count++ % every != 0) continue;
                    const smx_scene s = test::make_scene(width, height, test::radians(light), x, g);
                    const test::Image image = render(s);
                    ASSERT_NO_FATAL_FAILURE(expect_sound(image, s, surface, what));
                }
}

} // namespace

TEST(Finite, Filtered) {
    const test::Material material = test::make_material(
        {{0.1, 1e-4}, {0.2, 1e-3}, {0.2, 0.01}, {0.3, 0.2}, {0.1, 20.0}, {0.1, 1e4}}, test::channel_fresnel);
    for_all_scenes([&](const smx_scene &s) { return test::render_filtered(material, s); }, Surface::sphere, "filtered");
}

TEST(Finite, Reference) {
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:two-layer", brdf.out()));
    for_all_scenes([&](const smx_scene &s) { return test::render_reference(brdf, s, test::make_options(4)); },
                   Surface::sphere, "reference");
}

TEST(Finite, ReferenceOfASharpTableByNearestLookup) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 2e-4}}, oracle::Masking::correlated));
    for_all_scenes(
        [&](const smx_scene &s) {
            return test::render_reference(brdf, s, test::make_options(1, 9, SMX_LOOKUP_NEAREST));
        },
        Surface::sphere, "nearest");
}

TEST(Finite, Geometry) {
    for_all_scenes(
        [](const smx_scene &s) {
            test::Image image;
            EXPECT_SMX_OK(smx_render_geometry(test::context(), &s, nullptr, image.out(), nullptr));
            return image;
        },
        Surface::displaced, "geometry", 17);
}

// Light from exactly behind reaches nothing that the camera sees.
TEST(Finite, LightFromBehindIsBlack) {
    const test::Material material = test::make_material({{1.0, 0.3}});
    const test::Image image =
        test::render_filtered(material, test::make_scene(64, 64, test::radians(-90.0), {0.25, 0.25, 0.0, 0.0, 0.0}));
    double highest = -1.0;
    ASSERT_SMX_OK(smx_image_quantile(image, 1.0, &highest));
    EXPECT_LT(highest, 1e-6);
}
