/* Densities from samples and from files, with every bad argument. */
#include "c_objects.h"

static const double theta[3] = {0.0, 0.5, 1.0}, values[3] = {1.0, 0.5, 0.0};

static void check_arguments(void) {
    smx_density density = (smx_density)UNTOUCHED;
    INVALID("name", smx_density_from_samples(NULL, SMX_DENSITY_P22, 3, theta, values, &density));
    INVALID("theta", smx_density_from_samples("x", SMX_DENSITY_P22, 3, NULL, values, &density));
    INVALID("values", smx_density_from_samples("x", SMX_DENSITY_P22, 3, theta, NULL, &density));
    INVALID("density", smx_density_from_samples("x", SMX_DENSITY_P22, 3, theta, values, NULL));
    INVALID("kind is 2", smx_density_from_samples("x", (smx_density_kind)2, 3, theta, values, &density));
    INVALID("kind", smx_density_from_samples("x", (smx_density_kind)-1, 3, theta, values, &density));
    INVALID("count is 1", smx_density_from_samples("x", SMX_DENSITY_P22, 1, theta, values, &density));
    INVALID("count is 0", smx_density_from_samples("x", SMX_DENSITY_P22, 0, theta, values, &density));
    INVALID("1048577", smx_density_from_samples("x", SMX_DENSITY_P22, 1048577, theta, values, &density));
    INVALID("count", smx_density_from_samples("x", SMX_DENSITY_P22, (size_t)-1, theta, values, &density));
    CHECK(density == (smx_density)UNTOUCHED);
}

static void refuse(const char *needle, double t, double value) {
    const double bad_theta[3] = {0.0, t, 1.0}, bad_values[3] = {1.0, value, 0.5};
    smx_density density = (smx_density)UNTOUCHED;
    INVALID(needle, smx_density_from_samples("x", SMX_DENSITY_NDF, 3, bad_theta, bad_values, &density));
    CHECK(density == (smx_density)UNTOUCHED);
}

static void check_samples(void) {
    const double zeros[3] = {0.0, 0.0, 0.0};
    smx_density density = (smx_density)UNTOUCHED;
    refuse("sample 1", NAN, 0.5);
    refuse("inf", INFINITY, 0.5);
    refuse("-0.1", -0.1, 0.5);
    refuse("radians", 45.0, 0.5);
    refuse("sample 1", 0.0, 0.5);
    refuse("sample 2", 1.0, 0.5);
    refuse("sample 1", 0.5, NAN);
    refuse("inf", 0.5, INFINITY);
    refuse("-1e-300", 0.5, -1e-300);
    refuse("1e+31", 0.5, 1e31);
    FAILS(SMX_NO_SOLUTION, "0 at every", smx_density_from_samples("x", SMX_DENSITY_P22, 3, theta, zeros, &density));
    CHECK(density == (smx_density)UNTOUCHED);
}

static void check_file(void) {
    smx_density density = (smx_density)UNTOUCHED;
    INVALID("path", smx_density_read_csv(NULL, &density));
    INVALID("density", smx_density_read_csv("x.csv", NULL));
    FAILS(SMX_CANNOT_READ, "no/such.csv", smx_density_read_csv("no/such.csv", &density));
    FAILS(SMX_CANNOT_READ, "folder", smx_density_read_csv(".", &density));
    FAILS(SMX_CANNOT_READ, "", smx_density_read_csv("", &density));
    CHECK(density == (smx_density)UNTOUCHED);
}

static void check_fit(void) {
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    smx_density density = NULL;
    smx_material material = (smx_material)UNTOUCHED;
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    smx_density_info density_info = SMX_DENSITY_INFO_INIT;
    OK(smx_density_from_samples("samples", SMX_DENSITY_P22, 3, theta, values, &density));
    density_info.sha256[0] = 'x';
    OK(smx_density_get_info(density, &density_info));
    CHECK(density_info.sha256[0] == '\0');
    INVALID("no BRDF", smx_material_fit(density, NULL, &material));
    INVALID("shared", smx_material_fit(density, &options, &material));
    options.model = SMX_MODEL_SHARED;
    options.lobes = 65;
    INVALID("65", smx_material_fit(density, &options, &material));
    CHECK(material == (smx_material)UNTOUCHED);
    options.lobes = 2;
    OK(smx_material_fit(density, &options, &material));
    smx_density_release(density);
    OK(smx_material_get_info(material, &info));
    CHECK(strcmp(info.name, "samples") == 0 && strcmp(info.source, "memory") == 0 && info.sha256[0] == '\0');
    smx_material_release(material);
}

int main(void) {
    check_arguments();
    check_samples();
    check_file();
    check_fit();
    return c_check_result();
}
