/* smx_density_tabulate and smx_material_tabulate with every bad argument. */
#include "c_objects.h"

static void check_name(smx_brdf brdf, const char *name) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    OK(smx_brdf_get_info(brdf, &info));
    CHECK(strcmp(info.name, name) == 0 && strcmp(info.source, "memory") == 0);
    smx_brdf_release(brdf);
}

static void check_material(void) {
    smx_material material = c_material();
    smx_brdf brdf = (smx_brdf)UNTOUCHED;
    INVALID("material", smx_material_tabulate(NULL, &brdf));
    INVALID("brdf", smx_material_tabulate(material, NULL));
    CHECK(brdf == (smx_brdf)UNTOUCHED);
    OK(smx_material_tabulate(material, &brdf));
    smx_material_release(material);
    check_name(brdf, "paint");
}

/* Sharp and bright beyond what a table takes: 1e20 / (4 pi alpha^2 cos^2) at grazing wi and wo. */
static void check_too_high(void) {
    const double fresnel[6] = {1e20, 1e20, 1e20, 1e20, 1e20, 1e20};
    const smx_lobe lobe = {1.0, 1e-4};
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    smx_material material = NULL;
    smx_brdf brdf = (smx_brdf)UNTOUCHED;
    desc.lobes = &lobe;
    desc.lobe_count = 1;
    desc.fresnel = fresnel;
    desc.knots = 2;
    OK(smx_material_create(&desc, &material));
    FAILS(SMX_BAD_FORMAT, "the highest is 1e+30", smx_material_tabulate(material, &brdf));
    CHECK(brdf == (smx_brdf)UNTOUCHED);
    smx_material_release(material);
}

static void check_density(void) {
    const double theta[2] = {0.0, 1.5}, values[2] = {1.0, 0.5};
    smx_density density = NULL;
    smx_brdf source = c_brdf(), brdf = (smx_brdf)UNTOUCHED;
    OK(smx_density_create(source, NULL, &density));
    smx_brdf_release(source);
    INVALID("density", smx_density_tabulate(NULL, &brdf));
    INVALID("brdf", smx_density_tabulate(density, NULL));
    CHECK(brdf == (smx_brdf)UNTOUCHED);
    OK(smx_density_tabulate(density, &brdf));
    smx_density_release(density);
    check_name(brdf, "conductor");

    OK(smx_density_from_samples("samples", SMX_DENSITY_P22, 2, theta, values, &density));
    OK(smx_density_tabulate(density, &brdf));
    smx_density_release(density);
    check_name(brdf, "samples");
}

int main(void) {
    check_material();
    check_too_high();
    check_density();
    return c_check_result();
}
