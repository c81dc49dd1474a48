/* smx_brdf_* and smx_density_* with every bad argument: the exact status, a message, outputs untouched. */
#include "c_objects.h"

static void check_open(void) {
    smx_brdf brdf = (smx_brdf)UNTOUCHED;
    INVALID("path", smx_brdf_open(NULL, &brdf));
    INVALID("brdf", smx_brdf_open("builtin:conductor", NULL));
    INVALID("glass", smx_brdf_open("builtin:glass", &brdf));
    FAILS(SMX_CANNOT_READ, "no/such/file.binary", smx_brdf_open("no/such/file.binary", &brdf));
    FAILS(SMX_CANNOT_READ, "", smx_brdf_open("", &brdf));
    CHECK(brdf == (smx_brdf)UNTOUCHED);
}

static void check_create(void) {
    const size_t count = (size_t)3 * 90 * 90 * 180;
    double *values = malloc(count * sizeof *values);
    smx_brdf brdf = (smx_brdf)UNTOUCHED;
    size_t k;
    for (k = 0; k < count; ++k) values[k] = 0.5;
    INVALID("name", smx_brdf_create(NULL, 180, values, &brdf));
    INVALID("values", smx_brdf_create("x", 180, NULL, &brdf));
    INVALID("brdf", smx_brdf_create("x", 180, values, NULL));
    INVALID("179", smx_brdf_create("x", 179, values, &brdf));
    INVALID("0", smx_brdf_create("x", 0, values, &brdf));
    INVALID("4294967295", smx_brdf_create("x", UINT32_MAX, values, &brdf));
    values[count - 1] = NAN;
    FAILS(SMX_BAD_FORMAT, "", smx_brdf_create("x", 180, values, &brdf));
    values[count - 1] = INFINITY;
    FAILS(SMX_BAD_FORMAT, "inf", smx_brdf_create("x", 180, values, &brdf));
    for (k = 0; k < count; ++k) values[k] = -1.0;
    FAILS(SMX_BAD_FORMAT, "", smx_brdf_create("x", 180, values, &brdf));
    CHECK(brdf == (smx_brdf)UNTOUCHED);
    free(values);
}

static void check_brdf_info(smx_brdf brdf) {
    const size_t sizes[] = WRONG_SIZES(smx_brdf_info);
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    size_t k;
    INVALID("brdf", smx_brdf_get_info(NULL, &info));
    INVALID("info", smx_brdf_get_info(brdf, NULL));
    for (k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        info.size = sizes[k];
        INVALID("size", smx_brdf_get_info(brdf, &info));
        CHECK(info.size == sizes[k]);
    }
    CHECK(info.cells == 0 && info.name[0] == '\0');
}

static void check_values(smx_brdf brdf) {
    double value = -7.0;
    INVALID("brdf", smx_brdf_get_values(NULL, &value, 1));
    INVALID("values", smx_brdf_get_values(brdf, NULL, (size_t)3 * 90 * 90 * 180));
    INVALID("4373999", smx_brdf_get_values(brdf, &value, (size_t)3 * 90 * 90 * 180 - 1));
    INVALID("0", smx_brdf_get_values(brdf, &value, 0));
    CHECK(value == -7.0);
}

static void check_write(smx_brdf brdf) {
    INVALID("brdf", smx_brdf_write(NULL, "x.binary"));
    INVALID("path", smx_brdf_write(brdf, NULL));
    FAILS(SMX_CANNOT_WRITE, "no/such/folder", smx_brdf_write(brdf, "no/such/folder/x.binary"));
    FAILS(SMX_CANNOT_WRITE, "", smx_brdf_write(brdf, ""));
}

static void check_inversion_options(smx_brdf brdf) {
    const size_t sizes[] = WRONG_SIZES(smx_inversion_options);
    const smx_inversion_options good = SMX_INVERSION_OPTIONS_INIT;
    smx_inversion_options bad = good;
    smx_density density = (smx_density)UNTOUCHED;
    const double tolerances[] = {0.0, -1.0, NAN, INFINITY};
    size_t k;
    INVALID("brdf", smx_density_create(NULL, NULL, &density));
    INVALID("density", smx_density_create(brdf, NULL, NULL));
    for (k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        bad.size = sizes[k];
        INVALID("size", smx_density_create(brdf, &bad, &density));
    }
    bad = good;
    bad.masking_kernel = (smx_masking_kernel)2;
    INVALID("2", smx_density_create(brdf, &bad, &density));
    bad.masking_kernel = (smx_masking_kernel)-1;
    INVALID("masking", smx_density_create(brdf, &bad, &density));
    for (k = 0; k < 4; ++k) {
        bad = good;
        bad.tolerance = tolerances[k];
        INVALID("tolerance", smx_density_create(brdf, &bad, &density));
    }
    bad = good;
    bad.max_iterations = 0;
    INVALID("max_iterations", smx_density_create(brdf, &bad, &density));
    bad.max_iterations = 100001;
    INVALID("100001", smx_density_create(brdf, &bad, &density));
    CHECK(density == (smx_density)UNTOUCHED);
}

static void check_density(smx_brdf brdf) {
    const size_t sizes[] = WRONG_SIZES(smx_density_info);
    smx_density density = NULL;
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    double value = -7.0;
    size_t k, nodes;
    OK(smx_density_create(brdf, NULL, &density));
    INVALID("density", smx_density_get_info(NULL, &info));
    INVALID("info", smx_density_get_info(density, NULL));
    for (k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        info.size = sizes[k];
        INVALID("size", smx_density_get_info(density, &info));
    }
    CHECK(info.nodes == 0);
    info.size = sizeof info;
    OK(smx_density_get_info(density, &info));
    nodes = info.nodes;
    INVALID("density", smx_density_get_nodes(NULL, &value, NULL, NULL, nodes));
    INVALID("nodes", smx_density_get_nodes(density, &value, &value, &value, nodes + 1));
    INVALID("0", smx_density_get_nodes(density, &value, &value, &value, 0));
    CHECK(value == -7.0);
    OK(smx_density_get_nodes(density, NULL, NULL, NULL, nodes));
    smx_density_release(density);
}

int main(void) {
    smx_brdf brdf = c_brdf();
    check_open();
    check_create();
    check_brdf_info(brdf);
    check_values(brdf);
    check_write(brdf);
    check_inversion_options(brdf);
    check_density(brdf);
    smx_brdf_release(brdf);
    return c_check_result();
}
