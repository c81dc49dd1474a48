/* smx_image_* with every bad argument. */
#include "c_objects.h"

static void check_create(void) {
    const float pixel[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    smx_image image = (smx_image)UNTOUCHED;
    INVALID("image", smx_image_create(1, 1, pixel, NULL));
    INVALID("0", smx_image_create(0, 1, pixel, &image));
    INVALID("0", smx_image_create(1, 0, NULL, &image));
    INVALID("16385", smx_image_create(16385, 1, NULL, &image));
    INVALID("16385", smx_image_create(1, 16385, NULL, &image));
    INVALID("4294967295", smx_image_create(UINT32_MAX, UINT32_MAX, NULL, &image));
    CHECK(image == (smx_image)UNTOUCHED);
    OK(smx_image_create(16384, 1, NULL, &image));
    smx_image_release(image);
}

static void check_size(smx_image image) {
    uint32_t width = 77, height = 77;
    INVALID("image", smx_image_get_size(NULL, &width, &height));
    INVALID("width", smx_image_get_size(image, NULL, &height));
    INVALID("height", smx_image_get_size(image, &width, NULL));
    CHECK(width == 77 && height == 77);
}

static void check_attributes(smx_image image) {
    static const char *const own[] = {"channels",  "compression",      "dataWindow",         "displayWindow",
                                      "lineOrder", "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth"};
    char longest[257];
    size_t k;
    memset(longest, 'k', sizeof longest);
    longest[256] = '\0';
    INVALID("image", smx_image_set_attribute(NULL, "key", "value"));
    INVALID("key", smx_image_set_attribute(image, NULL, "value"));
    INVALID("value", smx_image_set_attribute(image, "key", NULL));
    INVALID("key", smx_image_set_attribute(image, "", "value"));
    INVALID("256", smx_image_set_attribute(image, longest, "value"));
    for (k = 0; k < 8; ++k) INVALID(own[k], smx_image_set_attribute(image, own[k], "value"));
    CHECK(smx_image_get_attribute(image, "key") == NULL);
    CHECK(smx_image_get_attribute(image, NULL) == NULL);
    CHECK(smx_image_get_attribute(image, "channels") == NULL);
    OK(smx_image_set_attribute(image, "key", "value"));
    OK(smx_image_set_attribute(image, "key", "other"));
    CHECK(strcmp(smx_image_get_attribute(image, "key"), "other") == 0);
}

static void check_files(smx_image image) {
    smx_image read = (smx_image)UNTOUCHED;
    INVALID("path", smx_image_read_exr(NULL, &read));
    INVALID("image", smx_image_read_exr("x.exr", NULL));
    FAILS(SMX_CANNOT_READ, "no/such", smx_image_read_exr("no/such/file.exr", &read));
    INVALID("image", smx_image_write_exr(NULL, "x.exr"));
    INVALID("path", smx_image_write_exr(image, NULL));
    FAILS(SMX_CANNOT_WRITE, "no/such", smx_image_write_exr(image, "no/such/file.exr"));
    INVALID("image", smx_image_write_png(NULL, "x.png", 1.0));
    INVALID("path", smx_image_write_png(image, NULL, 1.0));
    FAILS(SMX_CANNOT_WRITE, "no/such", smx_image_write_png(image, "no/such/file.png", 1.0));
    CHECK(read == (smx_image)UNTOUCHED);
}

static void check_display(smx_image image) {
    static const double bad[] = {0.0, -1.0, NAN, INFINITY};
    uint8_t rgb[12] = {77};
    size_t k;
    INVALID("image", smx_image_display(NULL, 1.0, rgb, 12));
    INVALID("rgb", smx_image_display(image, 1.0, NULL, 12));
    INVALID("11", smx_image_display(image, 1.0, rgb, 11));
    INVALID("16", smx_image_display(image, 1.0, rgb, 16));
    for (k = 0; k < 4; ++k) {
        INVALID("exposure", smx_image_display(image, bad[k], rgb, 12));
        INVALID("exposure", smx_image_write_png(image, "never-made.png", bad[k]));
    }
    CHECK(rgb[0] == 77);
    CHECK(fopen("never-made.png", "rb") == NULL);
}

static void check_quantile(smx_image image) {
    static const double bad[] = {-0.1, 1.1, NAN, INFINITY, -INFINITY};
    double value = -7.0;
    size_t k;
    INVALID("image", smx_image_quantile(NULL, 0.5, &value));
    INVALID("value", smx_image_quantile(image, 0.5, NULL));
    for (k = 0; k < 5; ++k) INVALID("q", smx_image_quantile(image, bad[k], &value));
    CHECK(value == -7.0);
}

static void check_compare(smx_image image) {
    const size_t sizes[] = WRONG_SIZES(smx_comparison);
    smx_comparison comparison = SMX_COMPARISON_INIT;
    smx_image other = c_image(3, 2);
    size_t k;
    comparison.rmse = -7.0;
    INVALID("image", smx_image_compare(NULL, image, &comparison));
    INVALID("reference", smx_image_compare(image, NULL, &comparison));
    INVALID("comparison", smx_image_compare(image, image, NULL));
    INVALID("3", smx_image_compare(image, other, &comparison));
    INVALID("alpha", smx_image_compare(image, image, &comparison));
    for (k = 0; k < 5; ++k) {
        comparison.size = sizes[k];
        INVALID("size", smx_image_compare(image, image, &comparison));
    }
    CHECK(comparison.rmse == -7.0);
    smx_image_release(other);
}

int main(void) {
    smx_image image = c_image(2, 2);
    check_create();
    check_size(image);
    check_attributes(image);
    check_files(image);
    check_display(image);
    check_quantile(image);
    check_compare(image);
    smx_image_release(image);
    return c_check_result();
}
