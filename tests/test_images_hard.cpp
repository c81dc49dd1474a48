// Images where they are hardest: the poles, the silhouette and the terminator, a light exactly behind, sides of 1 and
// of 16384, sums of 2^20 samples, and one pixel that outshines all others by thirty decades.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "close.h"
#include "files.h"
#include "oracle_sphere.h"
#include "support.h"

using oracle::Masking;
using oracle::Mixture;

namespace {

// Of a pixel, a few roundings times what its condition makes of them.
constexpr double roundings = 4 * 0x1p-24;
constexpr double smallest_float = 0x1p-126; // below it no relative error is asked for
// What is asked of a sum of 2^20 floats, and of the factors around it.
constexpr double sum_tolerance = 1e-6;
// Double sums of the metrics.
constexpr double metric_tolerance = 1e-12;
// Where float32 may see a pixel's centre on the other side of the silhouette or the terminator.
constexpr double silhouette = 1e-6;

constexpr smx_displacement rough{0.3, 0.2, 0.5, 0.0, 0.0};

const std::vector<oracle::Lobe> &lobes() {
    static const std::vector<oracle::Lobe> list{{0.4, 0.1}, {0.6, 0.5}};
    return list;
}

const test::Brdf &brdf() {
    static const test::Brdf b = test::make_brdf(test::beckmann_table(lobes(), Masking::correlated));
    return b;
}

test::Image reference(const smx_scene &scene, smx_sampler sampler, uint32_t spp, smx_grade grade = SMX_GRADE_PRECISE) {
    smx_render_options options = test::make_options(spp, 3);
    options.sampler = sampler;
    options.grade = grade;
    options.errors = sampler != SMX_SAMPLER_GRID;
    return test::render_reference(brdf(), scene, options);
}

// All that can be rendered of a scene.
std::vector<test::Image> all_images(const smx_scene &scene) {
    std::vector<test::Image> images;
    images.push_back(test::render_filtered(test::make_material(lobes()), scene));
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS})
        images.push_back(reference(scene, sampler, 16));
    return images;
}

test::Image make_image(uint32_t width, uint32_t height, const std::vector<float> &rgba) {
    test::Image image;
    EXPECT_SMX_OK(smx_image_create(width, height, rgba.data(), image.out()));
    return image;
}

// 64 x 64 of one value, but for a pixel in the middle.
test::Image with_one_pixel(float everywhere, float bright) {
    std::vector<float> rgba;
    for (std::size_t k = 0; k < 64 * 64; ++k) {
        const float value = k == 2080 ? bright : everywhere;
        rgba.insert(rgba.end(), {value, value, value, 1.0f});
    }
    return make_image(64, 64, rgba);
}

// f cos under a pixel's centre, moved by some columns and rows and its directions by a vector each.
double moved(const Mixture &mixture, const smx_scene &scene, double column, double row, const oracle::Vec &to_wi = {},
             const oracle::Vec &to_wo = {}) {
    const auto side = static_cast<int>(scene.width);
    const oracle::Pixel p = oracle::sphere_pixel(side, side, column, row, scene.light_phi);
    return oracle::fcos(mixture, Masking::correlated, p.wi + to_wi, p.wo + to_wo);
}

// Condition of f cos over what a frame of floats is told by: the three coordinates of wi, each to a rounding of 1;
// those of wo, each to a rounding of itself, for they are products; and wh, which is the view's and turned by itself,
// through both.
double condition(const Mixture &mixture, const smx_scene &scene, uint32_t column, uint32_t row,
                 const oracle::Pixel &p) {
    const oracle::Vec axes[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const double of_wo[] = {std::abs(p.wo.x), std::abs(p.wo.y), p.wo.z};
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        // Steps that keep the cosines above the horizon, where f cos has a kink.
        const double step_i = k == 2 ? std::min(1e-7, p.wi.z / 4.0) : 1e-7;
        const double step_o = k == 2 ? std::min(1e-7, p.wo.z / 4.0) : 1e-7;
        const double by_i = (moved(mixture, scene, column, row, step_i * axes[k]) -
                             moved(mixture, scene, column, row, -step_i * axes[k])) /
                            (2.0 * step_i);
        const double by_o = (moved(mixture, scene, column, row, {}, step_o * axes[k]) -
                             moved(mixture, scene, column, row, {}, -step_o * axes[k])) /
                            (2.0 * step_o);
        sum += std::abs(by_i) + std::abs(by_o) * of_wo[k];
    }
    return sum / moved(mixture, scene, column, row);
}

double quantile(smx_image image, double q) {
    double value = -1.0;
    EXPECT_SMX_OK(smx_image_quantile(image, q, &value));
    return value;
}

} // namespace

// Rows at the poles, columns at the silhouette, pixels beside the terminator: the closed form in double.
TEST(ImagesHard, EdgesAreAsEverywhere) {
    const test::Material material = test::make_material(lobes());
    const Mixture mixture{lobes(), test::gaussian(rough)};
    constexpr uint32_t side = 1023; // has a middle column, which meets the poles
    for (const double light : {90.0, 0.0, -60.0, 150.0}) {
        const smx_scene scene = test::make_scene(side, side, test::radians(light), rough);
        const test::Image image = test::render_filtered(material, scene);
        const test::Pixels pixels = test::pixels(image);
        int poles = 0, edges = 0, terminator = 0;
        double largest = 0.0, widest = 0.0;
        for (uint32_t row = 0; row < side; ++row)
            for (uint32_t column = 0; column < side; ++column) {
                const oracle::Pixel p = oracle::sphere_pixel(side, side, column, row, scene.light_phi);
                if (!p.on_sphere || p.edge_distance < silhouette || std::abs(p.wi.z) < silhouette) continue;
                const bool pole = row < 3 || row + 3 >= side, edge = p.wo.z < 0.05, dusk = std::abs(p.wi.z) < 2e-3;
                if (!pole && !edge && !dusk) continue;
                poles += pole, edges += edge, terminator += dusk;
                const double wanted = oracle::fcos(mixture, Masking::correlated, p.wi, p.wo);
                if (wanted == 0.0) {
                    ASSERT_EQ(pixels.at(column, row)[0], 0.0f);
                    continue;
                }
                const double tolerance = roundings * (1.0 + condition(mixture, scene, column, row, p));
                if (wanted > smallest_float)
                    largest = std::max(largest, std::abs(pixels.at(column, row)[0] / wanted - 1.0) / tolerance);
                widest = std::max(widest, tolerance);
                ASSERT_TRUE(test::is_close(pixels.at(column, row)[0], wanted, tolerance, smallest_float))
                    << "light " << light << ", pixel " << column << " " << row << ", wi.z " << p.wi.z << ", wo.z "
                    << p.wo.z << ": " << pixels.at(column, row)[0] << ", wanted " << wanted;
            }
        std::printf(
            "light %g: %d pixels at poles, %d at edges, %d at dusk; error at most %.2g of its bound, which is "
            "at most %.1g\n",
            light, poles, edges, terminator, largest, widest);
        EXPECT_GT(poles, 50);
        EXPECT_GT(edges, 500);
        EXPECT_GE(terminator, light == 90.0 ? 0 : 100);
    }
}

// What is behind lights nothing that is seen: not a pixel is other than 0, nor has it an error.
TEST(ImagesHard, LightExactlyBehindIsBlack) {
    for (const smx_displacement &x : {rough, smx_displacement{0.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.5, 0.0, 0.3, 0.0}})
        for (const uint32_t side : {1u, 64u, 255u})
            for (const double turns : {0.0, 3.0})
                for (const test::Image &image :
                     all_images(test::make_scene(side, side, test::radians(-90.0 + 360.0 * turns), x))) {
                    EXPECT_EQ(quantile(image, 0.0), 0.0);
                    EXPECT_EQ(quantile(image, 1.0), 0.0) << side << " " << turns;
                    const float *errors = smx_image_errors(image);
                    for (std::size_t k = 0; errors && k < std::size_t{4} * side * side; ++k)
                        ASSERT_TRUE(errors[k] == 0.0f || k % 4 == 3) << errors[k];
                }
}

// A strip of odd length has one pixel on the sphere, the middle one; of even length none, as both are on its edge.
TEST(ImagesHard, StripsHaveOnePixelOrNone) {
    const auto bright = [](uint32_t width, uint32_t height) {
        std::vector<std::size_t> found;
        for (const test::Image &image : all_images(test::make_scene(width, height, test::radians(60.0), rough))) {
            const test::Pixels p = test::pixels(image);
            std::size_t lit = 0;
            for (std::size_t k = 0; k < std::size_t{width} * height; ++k) {
                EXPECT_EQ(p.rgba[4 * k] > 0.0f, p.rgba[4 * k + 3] == 1.0f);
                EXPECT_TRUE(p.rgba[4 * k + 3] == 0.0f || k == std::size_t{width} * height / 2);
                lit += p.rgba[4 * k + 3] == 1.0f;
            }
            found.push_back(lit);
        }
        return found;
    };
    EXPECT_EQ(bright(1, 1), (std::vector<std::size_t>{1, 1, 1, 1}));
    EXPECT_EQ(bright(1, 16383), (std::vector<std::size_t>{1, 1, 1, 1}));
    EXPECT_EQ(bright(16383, 1), (std::vector<std::size_t>{1, 1, 1, 1}));
    EXPECT_EQ(bright(1, 16384), (std::vector<std::size_t>{0, 0, 0, 0}));
    EXPECT_EQ(bright(16384, 1), (std::vector<std::size_t>{0, 0, 0, 0}));
    const smx_scene strip = test::make_scene(1, 16383, test::radians(60.0), rough);
    const smx_scene one = test::make_scene(1, 1, test::radians(60.0), rough);
    const test::Image whole = reference(strip, SMX_SAMPLER_MIS, 256), alone = reference(one, SMX_SAMPLER_MIS, 256);
    EXPECT_EQ(test::pixels(whole).at(0, 8191)[0], test::pixels(alone).at(0, 0)[0]);
}

// The same facets and the same directions, summed in double: what is left is the sum's error and that of a few factors.
TEST(ImagesHard, SumsOfAMillionSamples) {
    if (!test::has_double()) GTEST_SKIP() << "the device has no doubles";
    // Planes, [3][pairs]: from the normal to near grazing.
    const std::vector<float> wi{0.0f, 0.6f, -0.28f, 0.8f, 0.0f, 0.0f, 0.0f, 0.56f, 1.0f, 0.8f, 0.96f, 0.2154f};
    const std::vector<float> wo{0.0f, 0.0f, 0.28f, -0.6f, 0.6f, 0.8f, 0.0f, 0.48f, 0.8f, 0.6f, 0.96f, 0.64f};
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) {
        const auto integrated = [&](smx_grade grade) {
            smx_render_options options = test::make_options(1 << 20, 3);
            options.sampler = sampler;
            options.grade = grade;
            std::vector<float> fcos(wi.size());
            EXPECT_SMX_OK(smx_brdf_integrate(test::context(), brdf(), &rough, SMX_G2_CORRELATED, &options, 4, wi.data(),
                                             wo.data(), fcos.data(), nullptr, nullptr));
            return fcos;
        };
        const std::vector<float> got = integrated(SMX_GRADE_PRECISE), wanted = integrated(SMX_GRADE_DOUBLE);
        for (std::size_t k = 0; k < got.size(); ++k) {
            EXPECT_CLOSE(got[k], wanted[k], sum_tolerance, 0.0) << "sampler " << sampler << ", value " << k;
            EXPECT_GT(got[k], 0.0f);
        }
    }
}

// Terms that are all alike round alike, time after time: a Lambertian on a surface that is nearly smooth, f cos known.
TEST(ImagesHard, SumsOfAMillionEqualSamples) {
    test::Brdf lambertian;
    ASSERT_SMX_OK(smx_brdf_open("analytic:lambert,albedo=0.7", lambertian.out()));
    const smx_displacement nearly_smooth{1e-5, 1e-5, 0.0, 0.0, 0.0};
    const float wi[] = {0.6f, 0.0f, 0.8f}, wo[] = {0.0f, 0.28f, 0.96f};
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL}) {
        smx_render_options options = test::make_options(1 << 20, 3);
        options.sampler = sampler;
        float fcos[3];
        ASSERT_SMX_OK(smx_brdf_integrate(test::context(), lambertian, &nearly_smooth, SMX_G2_CORRELATED, &options, 1,
                                         wi, wo, fcos, nullptr, nullptr));
        EXPECT_CLOSE(fcos[0], 0.7 / oracle::pi * 0.8, sum_tolerance, 0.0) << "sampler " << sampler;
    }
}

// A pixel of 2^20 samples: with the same samples in double, where there are such, or where every sample is the same.
TEST(ImagesHard, PixelsOfAMillionSamples) {
    const smx_scene scene = test::make_scene(1, 1, test::radians(60.0), rough);
    const auto red = [](const test::Image &image) { return double{test::pixels(image).at(0, 0)[0]}; };
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) {
        if (!test::has_double()) break;
        EXPECT_CLOSE(red(reference(scene, sampler, 1 << 20)), red(reference(scene, sampler, 1 << 20, SMX_GRADE_DOUBLE)),
                     sum_tolerance, 0.0)
            << "sampler " << sampler;
    }

    smx_scene furnace = scene;
    furnace.light = SMX_LIGHT_UNIFORM;
    const test::Material material = test::make_material(lobes());
    const auto uniform = [&](bool is_filtered, smx_grade grade) {
        smx_render_options options = SMX_RENDER_OPTIONS_INIT;
        options.spp = 1 << 20;
        options.seed = 3;
        options.grade = grade;
        test::Image image;
        EXPECT_SMX_OK(is_filtered
                          ? smx_render_filtered(test::context(), material, &furnace, &options, image.out(), nullptr)
                          : smx_render_reference(test::context(), brdf(), &furnace, &options, image.out(), nullptr));
        return red(image);
    };
    for (const bool is_filtered : {true, false}) {
        if (!test::has_double()) break;
        EXPECT_CLOSE(uniform(is_filtered, SMX_GRADE_PRECISE), uniform(is_filtered, SMX_GRADE_DOUBLE), sum_tolerance,
                     0.0)
            << (is_filtered ? "filtered" : "reference");
    }

    // On a smooth surface all rays see the same.
    test::Brdf lambertian;
    ASSERT_SMX_OK(smx_brdf_open("analytic:lambert,albedo=0.7", lambertian.out()));
    const smx_scene smooth = test::make_scene(1, 1, test::radians(60.0), {0.0, 0.0, 0.0, 0.0, 0.0});
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.spp = 1 << 20;
    smx_geometric_options geometric = SMX_GEOMETRIC_OPTIONS_INIT;
    geometric.tile = 64;
    geometric.realisations = 2;
    test::Image image;
    ASSERT_SMX_OK(
        smx_render_geometric(test::context(), lambertian, &smooth, &options, &geometric, image.out(), nullptr));
    EXPECT_CLOSE(red(image), 0.7 / oracle::pi * std::sin(test::radians(60.0)), sum_tolerance, 0.0);
}

// Metrics, quantiles and pictures of an image with one pixel of 1e30, or all but one black.
TEST(ImagesHard, OneBrightPixel) {
    const float dim = 0.25f, bright = 1e30f;
    const test::Image lone = with_one_pixel(dim, bright), flat = with_one_pixel(dim, dim);
    smx_comparison c = SMX_COMPARISON_INIT;
    ASSERT_SMX_OK(smx_image_compare(lone, flat, &c));
    EXPECT_CLOSE(c.max_error, double{bright}, metric_tolerance, 0.0);
    EXPECT_CLOSE(c.rmse, bright / 64.0, metric_tolerance, 0.0);
    EXPECT_CLOSE(c.relrmse, bright / 64.0 / dim, metric_tolerance, 0.0);
    EXPECT_CLOSE(c.bias, (bright / 4096.0) / dim, metric_tolerance, 0.0);
    ASSERT_SMX_OK(smx_image_compare(flat, lone, &c));
    EXPECT_CLOSE(c.relrmse, 1.0, metric_tolerance, 0.0);
    EXPECT_EQ(quantile(lone, 0.99), dim);
    EXPECT_EQ(quantile(lone, 1.0), double{bright});

    // The picture, with the exposure that the dim ones ask for and with the bright one's.
    std::vector<uint8_t> rgb(3 * 64 * 64);
    ASSERT_SMX_OK(smx_image_display(lone, 1.0 / quantile(lone, 0.99), rgb.data(), rgb.size()));
    EXPECT_EQ(*std::min_element(rgb.begin(), rgb.end()), 255);
    ASSERT_SMX_OK(smx_image_display(lone, 1.0 / bright, rgb.data(), rgb.size()));
    EXPECT_EQ(std::count(rgb.begin(), rgb.end(), 255), 3);
    EXPECT_EQ(std::count(rgb.begin(), rgb.end(), 0), 3 * 64 * 64 - 3);
    ASSERT_SMX_OK(smx_image_display(lone, 1e300, rgb.data(), rgb.size()));
    EXPECT_EQ(*std::min_element(rgb.begin(), rgb.end()), 255);
}

// Files are of floats, not of halves: neither 65505 nor 1e30 is infinite, and the least float is not 0.
TEST(ImagesHard, FilesHoldTheWholeRangeOfFloats) {
    const test::TempDir dir;
    for (const float value : {65504.0f, 65520.0f, 1e30f, std::numeric_limits<float>::max(), 6e-8f,
                              std::numeric_limits<float>::min(), std::numeric_limits<float>::denorm_min()}) {
        const test::Image image = with_one_pixel(0.25f, value);
        ASSERT_SMX_OK(smx_image_write_exr(image, (dir / "one.exr").c_str()));
        test::Image back;
        ASSERT_SMX_OK(smx_image_read_exr((dir / "one.exr").c_str(), back.out()));
        EXPECT_TRUE(std::equal(smx_image_pixels(image), smx_image_pixels(image) + 4 * 64 * 64, smx_image_pixels(back)))
            << value;
    }
}
