// Images in memory: pixels, quantile, comparison, display, against numbers done by hand.
#include <gtest/gtest.h>

#include <png.h>

#include <cstring>
#include <limits>

#include "close.h"
#include "files.h"
#include "support.h"

namespace {

// Sums of a few float32 values in double.
constexpr double sum_tolerance = 1e-12;

test::Image make_image(uint32_t width, uint32_t height, const std::vector<float> &rgba) {
    test::Image image;
    EXPECT_SMX_OK(smx_image_create(width, height, rgba.data(), image.out()));
    return image;
}

smx_comparison compare(smx_image a, smx_image b) {
    smx_comparison c = SMX_COMPARISON_INIT;
    EXPECT_SMX_OK(smx_image_compare(a, b, &c));
    return c;
}

double quantile(smx_image image, double q) {
    double value = -1.0;
    EXPECT_SMX_OK(smx_image_quantile(image, q, &value));
    return value;
}

std::vector<uint8_t> display(smx_image image, double exposure) {
    const test::Pixels p = test::pixels(image);
    std::vector<uint8_t> rgb(std::size_t{3} * p.width * p.height);
    EXPECT_SMX_OK(smx_image_display(image, exposure, rgb.data(), rgb.size()));
    return rgb;
}

std::vector<uint8_t> read_png(const std::string &path, uint32_t &width, uint32_t &height) {
    png_image png;
    std::memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&png, path.c_str()), 0) << png.message;
    png.format = PNG_FORMAT_RGB;
    std::vector<uint8_t> rgb(PNG_IMAGE_SIZE(png));
    EXPECT_NE(png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr), 0) << png.message;
    width = png.width;
    height = png.height;
    return rgb;
}

} // namespace

TEST(Image, NullPixelsAreBlackAndClear) {
    test::Image image;
    ASSERT_SMX_OK(smx_image_create(3, 2, nullptr, image.out()));
    const test::Pixels p = test::pixels(image);
    ASSERT_EQ(p.width, 3u);
    ASSERT_EQ(p.height, 2u);
    for (int k = 0; k < 24; ++k) EXPECT_EQ(p.rgba[k], 0.0f);
}

TEST(Image, PixelsAreCopied) {
    std::vector<float> rgba{1.0f, 2.0f, 3.0f, 4.0f};
    const test::Image image = make_image(1, 1, rgba);
    rgba[0] = 99.0f;
    EXPECT_EQ(smx_image_pixels(image)[0], 1.0f);
}

TEST(Image, ComparisonByHand) {
    // Two pixels count (alpha > 0 in the reference), the third does not, whatever it holds.
    const test::Image a = make_image(3, 1, {1, 2, 3, 1, 4, 5, 6, 0, 9, 9, 9, 1});
    const test::Image b = make_image(3, 1, {1, 2, 1, 0.5f, 4, 4, 4, 1, 0, 0, 0, 0});
    const smx_comparison c = compare(a, b);
    EXPECT_EQ(c.pixels, 2u);
    EXPECT_CLOSE(c.rmse, std::sqrt((4.0 + 1.0 + 4.0) / 6.0), sum_tolerance, 0.0);
    EXPECT_CLOSE(c.relrmse, std::sqrt(9.0 / 54.0), sum_tolerance, 0.0);
    EXPECT_CLOSE(c.max_error, 2.0, sum_tolerance, 0.0);
    EXPECT_CLOSE(c.bias, 21.0 / 16.0, sum_tolerance, 0.0);
}

TEST(Image, ComparisonWithItselfIsZero) {
    const test::Image a = make_image(1, 2, {1, 2, 3, 1, 4, 5, 6, 1});
    const smx_comparison c = compare(a, a);
    EXPECT_EQ(c.relrmse, 0.0);
    EXPECT_EQ(c.max_error, 0.0);
    EXPECT_EQ(c.bias, 1.0);
}

TEST(Image, ComparisonWithBlack) {
    const test::Image black = make_image(1, 1, {0, 0, 0, 1}), white = make_image(1, 1, {1, 1, 1, 1});
    EXPECT_EQ(compare(black, black).relrmse, 0.0);
    EXPECT_EQ(compare(black, black).bias, 1.0);
    EXPECT_EQ(compare(white, black).relrmse, HUGE_VAL);
    EXPECT_EQ(compare(white, black).bias, HUGE_VAL);
    EXPECT_EQ(compare(black, white).relrmse, 1.0);
    EXPECT_EQ(compare(black, white).bias, 0.0);
}

TEST(Image, ComparisonSeesNan) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const test::Image a = make_image(1, 1, {nan, 1, 1, 1}), b = make_image(1, 1, {1, 1, 1, 1});
    EXPECT_FALSE(compare(a, b).relrmse <= 1e30);
    EXPECT_FALSE(compare(a, b).max_error <= 1e30);
}

TEST(Image, ComparisonNeedsSomethingToCompare) {
    const test::Image a = make_image(2, 1, {1, 1, 1, 1, 1, 1, 1, 1}), b = make_image(1, 2, {1, 1, 1, 1, 1, 1, 1, 1});
    const test::Image clear = make_image(2, 1, {1, 1, 1, 0, 1, 1, 1, 0});
    smx_comparison c = SMX_COMPARISON_INIT;
    c.relrmse = -7.0;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "2", smx_image_compare(a, b, &c));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "", smx_image_compare(a, clear, &c));
    EXPECT_EQ(c.relrmse, -7.0);
}

TEST(Image, QuantilesByHand) {
    // Alpha 0 keeps 1000 out; nine values 1..9 are left.
    const test::Image image = make_image(2, 2, {9, 1, 5, 1, 1000, 1000, 1000, 0, 3, 7, 2, 0.5f, 8, 4, 6, 1});
    EXPECT_EQ(quantile(image, 0.0), 1.0);
    EXPECT_EQ(quantile(image, 0.5), 5.0);
    EXPECT_EQ(quantile(image, 1.0), 9.0);
    EXPECT_GE(quantile(image, 0.9), quantile(image, 0.8));
    test::Image clear;
    ASSERT_SMX_OK(smx_image_create(2, 2, nullptr, clear.out()));
    EXPECT_EQ(quantile(clear, 0.5), 0.0);
}

// IEC 61966-2-1: 12.92 x below 0.0031308, else 1.055 x^(1/2.4) - 0.055, in 255ths.
TEST(Image, DisplayIsSrgb) {
    const float over = 2.0f;
    const test::Image image = make_image(
        4, 1, {0.0f, 0.001f, 0.003f, 1, 0.0034f, 0.01f, 0.18f, 1, 0.22f, 0.5f, 1.0f, 1, over, -1.0f, 1e30f, 1});
    const std::vector<uint8_t> wanted{0, 3, 10, 11, 25, 118, 129, 188, 255, 255, 0, 255};
    const std::vector<uint8_t> got = display(image, 1.0);
    for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_EQ(got[k], wanted[k]) << "value " << k;
}

TEST(Image, ExposureScalesBeforeTheTransfer) {
    const test::Image dim = make_image(1, 1, {0.05f, 0.1f, 0.2f, 1}), bright = make_image(1, 1, {0.2f, 0.4f, 0.8f, 1});
    EXPECT_EQ(display(dim, 4.0), display(bright, 1.0));
    EXPECT_NE(display(dim, 1.0), display(bright, 1.0));
}

TEST(Image, BackgroundIsBlueWhateverTheExposure) {
    test::Image clear;
    ASSERT_SMX_OK(smx_image_create(1, 1, nullptr, clear.out()));
    const std::vector<uint8_t> rgb = display(clear, 1.0);
    EXPECT_GT(rgb[2], rgb[0]);
    EXPECT_GT(rgb[2], rgb[1]);
    EXPECT_EQ(display(clear, 10.0), rgb);
}

TEST(Image, PngHoldsTheDisplay) {
    const test::TempDir dir;
    std::vector<float> rgba;
    for (int k = 0; k < 7 * 5; ++k)
        rgba.insert(rgba.end(), {static_cast<float>(k) / 35.0f, 0.5f, 1.0f - static_cast<float>(k) / 35.0f,
                                 k % 3 == 0 ? 0.0f : 1.0f});
    const test::Image image = make_image(7, 5, rgba);
    ASSERT_SMX_OK(smx_image_write_png(image, (dir / "p.png").c_str(), 0.8));
    uint32_t width = 0, height = 0;
    EXPECT_EQ(read_png(dir / "p.png", width, height), display(image, 0.8));
    EXPECT_EQ(width, 7u);
    EXPECT_EQ(height, 5u);
}
