/* Statuses, version, and the life of handles: NULL, retain, release in every order. */
#include "c_objects.h"

static void check_statuses(void) {
    static const char *const names[] = {"SMX_OK",           "SMX_INVALID_ARGUMENT", "SMX_CANNOT_READ",
                                        "SMX_CANNOT_WRITE", "SMX_BAD_FORMAT",       "SMX_NO_DEVICE",
                                        "SMX_KERNEL_BUILD", "SMX_DEVICE_ERROR",     "SMX_OUT_OF_MEMORY",
                                        "SMX_NO_SOLUTION",  "SMX_CANCELLED",        "SMX_INTERNAL"};
    int k;
    for (k = 0; k <= (int)SMX_INTERNAL; ++k) {
        CHECK(strcmp(smx_status_name((smx_status)k), names[k]) == 0);
        CHECK(strlen(smx_status_text((smx_status)k)) > 0);
        CHECK(strcmp(smx_status_text((smx_status)k), "unknown status") != 0);
    }
    CHECK(strcmp(smx_status_name((smx_status)12), "unknown status") == 0);
    CHECK(strcmp(smx_status_text((smx_status)12), "unknown status") == 0);
    CHECK(strcmp(smx_status_name((smx_status)-1), "unknown status") == 0);
}

static void check_version(void) {
    char expected[64];
    CHECK(strcmp(smx_version(), SMX_VERSION_STRING) == 0);
    snprintf(expected, sizeof expected, "%d.%d.%d", SMX_VERSION_MAJOR, SMX_VERSION_MINOR, SMX_VERSION_PATCH);
    CHECK(strcmp(SMX_VERSION_STRING, expected) == 0);
}

static void check_null_handles(void) {
    smx_context_release(NULL);
    smx_brdf_release(NULL);
    smx_density_release(NULL);
    smx_material_release(NULL);
    smx_image_release(NULL);
    INVALID("context", smx_context_retain(NULL));
    INVALID("brdf", smx_brdf_retain(NULL));
    INVALID("density", smx_density_retain(NULL));
    INVALID("material", smx_material_retain(NULL));
    INVALID("image", smx_image_retain(NULL));
    CHECK(smx_image_pixels(NULL) == NULL);
    CHECK(smx_image_get_attribute(NULL, "key") == NULL);
}

/* A retained handle outlives the release of the first reference. */
static void check_retain(void) {
    smx_image image = c_image(2, 2);
    uint32_t width = 0, height = 0;
    OK(smx_image_retain(image));
    smx_image_release(image);
    OK(smx_image_get_size(image, &width, &height));
    CHECK(width == 2 && height == 2);
    smx_image_release(image);
}

/* A density keeps its BRDF, a material what it needs of its density, whichever is released first. */
static void check_release_orders(void) {
    int order;
    for (order = 0; order < 6; ++order) {
        static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        smx_brdf brdf = c_brdf();
        smx_density density = NULL;
        smx_material material = NULL;
        smx_fit_options options = SMX_FIT_OPTIONS_INIT;
        int step;
        options.lobes = 1;
        OK(smx_density_create(brdf, NULL, &density));
        OK(smx_material_fit(density, &options, &material));
        for (step = 0; step < 3; ++step) {
            smx_material_info info = SMX_MATERIAL_INFO_INIT;
            smx_density_info density_info = SMX_DENSITY_INFO_INIT;
            if (orders[order][step] == 0) {
                smx_brdf_release(brdf);
                brdf = NULL;
            } else if (orders[order][step] == 1) {
                smx_density_release(density);
                density = NULL;
            } else {
                smx_material_release(material);
                material = NULL;
            }
            if (density) OK(smx_density_get_info(density, &density_info));
            if (material) {
                OK(smx_material_get_info(material, &info));
                CHECK(info.lobes == 1);
                CHECK(strcmp(info.source, "builtin:conductor") == 0);
            }
        }
    }
}

int main(void) {
    CHECK(strcmp(smx_last_error(), "") == 0);
    check_statuses();
    check_version();
    check_null_handles();
    check_retain();
    check_release_orders();
    return c_check_result();
}
