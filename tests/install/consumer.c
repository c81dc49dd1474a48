/* A program outside the project: inverts builtin:conductor, whose alpha is 0.2, fits one lobe, and shades it at normal
 * incidence, where f cos = F(0) / (4 pi (alpha^2 + alpha_x^2)), D of a Beckmann lobe at its peak with no masking. */
#include <math.h>
#include <slopemix.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(int good, const char *what) {
    if (good) return;
    fprintf(stderr, "consumer: %s; last error: \"%s\"\n", what, smx_last_error());
    exit(EXIT_FAILURE);
}

static smx_material fit_one_lobe(void) {
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    smx_brdf brdf = NULL;
    smx_density density = NULL;
    smx_material material = NULL;
    options.model = SMX_MODEL_SHARED;
    options.lobes = 1;
    check(smx_brdf_open("builtin:conductor", &brdf) == SMX_OK, "cannot open builtin:conductor");
    check(smx_density_create(brdf, NULL, &density) == SMX_OK, "cannot invert it");
    check(smx_density_get_info(density, &info) == SMX_OK && info.converged, "the inversion did not converge");
    check(smx_material_fit(density, &options, &material) == SMX_OK, "cannot fit it");
    smx_density_release(density);
    smx_brdf_release(brdf);
    return material;
}

/* F at theta_d = 0: the first knot of each channel. */
static void curve_starts(smx_material material, double start[3]) {
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    size_t count, c;
    double *fresnel;
    check(smx_material_get_info(material, &info) == SMX_OK, "the material says nothing of itself");
    count = (size_t)3 * info.fresnel_knots;
    fresnel = malloc(count * sizeof *fresnel);
    check(fresnel && smx_material_get_fresnel(material, NULL, fresnel, count) == SMX_OK, "cannot read the curves");
    for (c = 0; c < 3; ++c) start[c] = fresnel[c * info.fresnel_knots];
    free(fresnel);
}

static void check_shading(smx_context context, smx_material material, double alpha, const double start[3],
                          double alpha_x) {
    const float up[3] = {0.0f, 0.0f, 1.0f};
    const double pi = 3.14159265358979323846, widened = alpha * alpha + alpha_x * alpha_x;
    smx_displacement rough = {0.0, 0.0, 0.0, 0.0, 0.0};
    float fcos[3];
    int c;
    rough.alpha_x = rough.alpha_y = alpha_x;
    check(smx_material_eval(context, material, &rough, SMX_G2_CORRELATED, NULL, 1, up, up, fcos) == SMX_OK,
          "cannot shade");
    for (c = 0; c < 3; ++c) {
        const double wanted = start[c] / (4.0 * pi * widened);
        check(wanted > 0.0 && fabs(fcos[c] - wanted) < 1e-5 * wanted, "f cos is not what the formula gives");
    }
}

int main(void) {
    smx_lobe lobe;
    double start[3];
    smx_material material = fit_one_lobe();
    smx_context context = NULL;
    check(strcmp(smx_version(), SMX_VERSION_STRING) == 0, "the header is of another version than the library");
    check(smx_material_get_lobes(material, &lobe, 1) == SMX_OK, "the fit has other than one lobe");
    check(fabs(lobe.alpha - 0.2) < 0.01, "the lobe is not builtin:conductor's"); /* of the inversion and the table */
    curve_starts(material, start);
    check(smx_context_create(NULL, &context) == SMX_OK, "no context");
    check_shading(context, material, lobe.alpha, start, 0.0);
    check_shading(context, material, lobe.alpha, start, 0.25);
    smx_context_release(context);
    smx_material_release(material);
    printf("alpha %.4f\n", lobe.alpha);
    return EXIT_SUCCESS;
}
