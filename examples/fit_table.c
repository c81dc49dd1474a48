/* Fits a measured table, or a material that stands in for one, and prints its lobes:
 *     fit_table [TABLE.binary | builtin:NAME | analytic:...] */
#include <math.h>
#include <string.h>

#include "check.h"

static smx_material fitted(smx_brdf brdf) {
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    smx_density density;
    smx_material material;
    options.lobes = SMX_LOBES_AUTO; /* as few as explain the table */
    OK(smx_density_create(brdf, NULL, &density));
    OK(smx_material_fit(density, &options, &material));
    smx_density_release(density);
    return material;
}

/* A lobe's colour: its Fresnel curves at normal incidence, where theta_d is 0. */
static void print_lobes(smx_material material) {
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    smx_lobe lobes[SMX_MAX_LOBES];
    double *fresnel, weights = 0.0;
    size_t values;
    OK(smx_material_get_info(material, &info));
    OK(smx_material_get_lobes(material, lobes, info.lobes));
    values = (size_t)info.fresnel_sets * 3 * info.fresnel_knots;
    fresnel = malloc(values * sizeof *fresnel);
    EXPECT(fresnel != NULL);
    OK(smx_material_get_fresnel(material, NULL, fresnel, values));
    printf("share    alpha        F at normal incidence\n");
    for (uint32_t k = 0; k < info.lobes; ++k) {
        const double *f = fresnel + (size_t)(info.fresnel_sets == 1 ? 0 : k) * 3 * info.fresnel_knots;
        printf("%.4f   %-10.4g   %.3f %.3f %.3f\n", lobes[k].weight, lobes[k].alpha, f[0], f[info.fresnel_knots],
               f[2 * info.fresnel_knots]);
        weights += lobes[k].weight;
    }
    EXPECT(fabs(weights - 1.0) < 1e-9);
    free(fresnel);
}

static void print_quality(smx_material material, smx_brdf brdf) {
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    OK(smx_material_get_report(material, &report));
    OK(smx_material_brdf_errors(material, brdf, &errors));
    printf("error of images: %.3f; of displaced surfaces: %.3f\n", report.base_relrmse, report.displaced_relrmse);
    printf("error in BRDF space: log %.2g, cube root %.2g\n", errors.log, errors.cube_root);
    EXPECT(report.lobes >= 1 && report.base_relrmse < 0.5);
}

/* builtin:conductor is one Beckmann lobe of alpha 0.2. */
static void check_conductor(smx_material material) {
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    smx_lobe lobes[SMX_MAX_LOBES];
    double heaviest = 0.0, alpha = 0.0;
    OK(smx_material_get_info(material, &info));
    OK(smx_material_get_lobes(material, lobes, info.lobes));
    for (uint32_t k = 0; k < info.lobes; ++k)
        if (lobes[k].weight > heaviest) heaviest = lobes[k].weight, alpha = lobes[k].alpha;
    EXPECT(fabs(alpha - 0.2) < 0.004);
}

int main(int argc, char **argv) {
    const char *input = argc > 1 ? argv[1] : "builtin:conductor";
    smx_brdf brdf;
    smx_material material;
    OK(smx_brdf_open(input, &brdf));
    material = fitted(brdf);
    printf("%s\n", input);
    print_lobes(material);
    print_quality(material, brdf);
    if (!strcmp(input, "builtin:conductor")) check_conductor(material);
    smx_material_release(material);
    smx_brdf_release(brdf);
    return EXIT_SUCCESS;
}
