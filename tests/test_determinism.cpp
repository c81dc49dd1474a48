// The same question has the same answer: same seed same bits, in any context; another vector width changes roundings
// only; another seed changes the noise.
#include <gtest/gtest.h>

#include <cstring>

#include "close.h"
#include "support.h"

using oracle::Masking;

namespace {

// Float32 sums in another order.
constexpr double width_tolerance = 1e-5;

const test::Brdf &brdf() {
    static const test::Brdf b = test::make_brdf(test::beckmann_table({{0.5, 0.05}, {0.5, 0.4}}, Masking::correlated));
    return b;
}

const test::Material &material() {
    static const test::Material m = test::make_material({{0.2, 0.02}, {0.3, 0.1}, {0.5, 0.4}}, test::channel_fresnel);
    return m;
}

test::Context context_of_width(uint32_t width) {
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.vector_width = width;
    test::Context c;
    EXPECT_SMX_OK(smx_context_create(&options, c.out()));
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    EXPECT_SMX_OK(smx_context_get_info(c, &info));
    EXPECT_EQ(info.vector_width, width);
    return c;
}

const std::vector<smx_scene> &scenes() {
    static const std::vector<smx_scene> list{
        test::make_scene(37, 23, test::radians(40.0), {0.25, 0.25, 0.0, 0.0, 0.0}),
        test::make_scene(23, 37, test::radians(-25.0), {0.5, 0.0, 0.0, 0.0, 0.0}),
        test::make_scene(33, 33, test::radians(90.0), {0.0, 0.1, 0.0, 0.2, 0.0}, SMX_G2_SEPARABLE),
        test::make_scene(33, 33, test::radians(0.0), {0.0, 0.0, 0.0, 0.0, 0.0}),
    };
    return list;
}

bool same_bits(smx_image a, smx_image b) {
    const test::Pixels x = test::pixels(a), y = test::pixels(b);
    return x.width == y.width && x.height == y.height &&
           std::memcmp(x.rgba, y.rgba, std::size_t{16} * x.width * x.height) == 0;
}

void expect_close_images(smx_image a, smx_image b, const std::string &what) {
    const test::Pixels x = test::pixels(a), y = test::pixels(b);
    for (std::size_t k = 0; k < std::size_t{4} * x.width * x.height; ++k)
        ASSERT_TRUE(test::is_close(x.rgba[k], y.rgba[k], width_tolerance, 1e-12))
            << what << ", value " << k << ": " << x.rgba[k] << " and " << y.rgba[k];
}

} // namespace

TEST(Determinism, VectorWidthsAgree) {
    const test::Context one = context_of_width(1);
    for (const uint32_t width : {4u, 8u, 16u}) {
        const test::Context wide = context_of_width(width);
        for (const smx_scene &s : scenes()) {
            const std::string what = "width " + std::to_string(width) + ", light " + std::to_string(s.light_phi);
            expect_close_images(test::render_filtered(material(), s, wide), test::render_filtered(material(), s, one),
                                "filtered, " + what);
            const smx_render_options options = test::make_options(400, 5);
            expect_close_images(test::render_reference(brdf(), s, options, wide),
                                test::render_reference(brdf(), s, options, one), "reference, " + what);
        }
    }
}

TEST(Determinism, SameSeedSameBits) {
    const test::Context other = context_of_width(16), again = context_of_width(16);
    for (const smx_scene &s : scenes()) {
        EXPECT_TRUE(
            same_bits(test::render_filtered(material(), s, other), test::render_filtered(material(), s, again)));
        const smx_render_options options = test::make_options(256, 77);
        const test::Image first = test::render_reference(brdf(), s, options, other);
        EXPECT_TRUE(same_bits(first, test::render_reference(brdf(), s, options, other)));
        EXPECT_TRUE(same_bits(first, test::render_reference(brdf(), s, options, again)));
    }
}

TEST(Determinism, SeedsDiffer) {
    const smx_scene &s = scenes()[0];
    const test::Image a = test::render_reference(brdf(), s, test::make_options(16, 1));
    for (const uint64_t seed : {uint64_t{2}, uint64_t{1} << 32, uint64_t{1} << 63, (uint64_t{1} << 32) + 1}) {
        const test::Image b = test::render_reference(brdf(), s, test::make_options(16, seed));
        EXPECT_FALSE(same_bits(a, b)) << "seed " << seed;
        EXPECT_GT(test::relrmse(a, b), 1e-3) << "seed " << seed;
    }
}
