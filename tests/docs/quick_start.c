/* The README's quick start, as a program: fits gold-paint.binary and shades three pairs of directions. */
#include <math.h>
#include <slopemix.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
    const float wi[] = {0.0f, 0.0f, 1.0f, 0.6f, 0.0f, 0.8f, 0.0f, 0.8f, 0.6f};
    const float wo[] = {0.0f, 0.0f, 1.0f, -0.6f, 0.0f, 0.8f, 0.8f, 0.0f, 0.6f};
    float fcos[9] = {0.0f};
    const size_t count = 3;

    smx_brdf brdf;
    smx_density density;
    smx_material material;
    smx_brdf_open("gold-paint.binary", &brdf);
    smx_density_create(brdf, NULL, &density);
    smx_material_fit(density, NULL, &material);

    smx_context context;
    smx_context_create(NULL, &context);
    smx_displacement rough = {0.25, 0.25, 0.0, 0.0, 0.0};
    smx_material_eval(context, material, &rough, SMX_G2_CORRELATED, NULL, count, wi, wo, fcos);

    for (size_t k = 0; k < 3 * count; k += 3) {
        printf("%g %g %g\n", (double)fcos[k], (double)fcos[k + 1], (double)fcos[k + 2]);
        if (!isfinite(fcos[k]) || fcos[k] <= 0.0f) return EXIT_FAILURE;
    }
    smx_context_release(context);
    smx_material_release(material);
    smx_density_release(density);
    smx_brdf_release(brdf);
    return EXIT_SUCCESS;
}
