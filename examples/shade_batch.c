/* Shades many pairs of directions at once, in the structs that they are in:
 *     shade_batch [TABLE.binary | builtin:NAME | analytic:...] */
#include <math.h>

#include "check.h"

/* What a renderer may have of a hit. */
typedef struct {
    float wi[3], wo[3]; /* unit vectors to the light and to the viewer, in the frame of the surface */
    int pixel;
    float fcos[3]; /* f times the cosine of wi, for r, g, b */
} Hit;

enum { COUNT = 1000, STRIDE = sizeof(Hit) / sizeof(float) };

/* The viewer 30 degrees from the normal, lights all along the circle on which it is. */
static void make_hits(Hit hits[COUNT]) {
    for (int k = 0; k < COUNT; ++k) {
        const double theta_i = 1.5 * (2.0 * k / (COUNT - 1) - 1.0), theta_o = 0.5235987755982988;
        hits[k].wi[0] = (float)sin(theta_i), hits[k].wi[1] = 0.0f, hits[k].wi[2] = (float)cos(theta_i);
        hits[k].wo[0] = (float)sin(theta_o), hits[k].wo[1] = 0.0f, hits[k].wo[2] = (float)cos(theta_o);
        hits[k].pixel = k;
    }
}

static void shade(const char *input, double alpha, Hit hits[COUNT]) {
    /* README */
    smx_brdf brdf;
    smx_density density;
    smx_material material;
    OK(smx_brdf_open(input, &brdf)); /* "gold-paint.binary", or "builtin:two-layer" */
    OK(smx_density_create(brdf, NULL, &density));
    OK(smx_material_fit(density, NULL, &material));

    smx_context context;
    smx_evaluator evaluator;
    const smx_displacement rough = {alpha, alpha, 0.0, 0.0, 0.0};
    OK(smx_context_create(NULL, &context));
    OK(smx_evaluator_create(context, material, &rough, SMX_G2_CORRELATED, NULL, &evaluator));

    const smx_vectors wi = {&hits->wi[0], &hits->wi[1], &hits->wi[2], STRIDE};
    const smx_vectors wo = {&hits->wo[0], &hits->wo[1], &hits->wo[2], STRIDE};
    const smx_vectors_out fcos = {&hits->fcos[0], &hits->fcos[1], &hits->fcos[2], STRIDE};
    OK(smx_evaluator_eval(evaluator, COUNT, &wi, &wo, &fcos));
    /* end of README */

    smx_evaluator_release(evaluator);
    smx_context_release(context);
    smx_material_release(material);
    smx_density_release(density);
    smx_brdf_release(brdf);
}

static float highest(const Hit hits[COUNT]) {
    float most = 0.0f;
    for (int k = 0; k < COUNT; ++k) {
        EXPECT(hits[k].pixel == k); /* what lies between is not touched */
        EXPECT(isfinite(hits[k].fcos[0]) && hits[k].fcos[0] >= 0.0f);
        most = fmaxf(most, hits[k].fcos[0]);
    }
    return most;
}

int main(int argc, char **argv) {
    static Hit measured[COUNT], displaced[COUNT];
    const char *input = argc > 1 ? argv[1] : "builtin:two-layer";
    make_hits(measured);
    make_hits(displaced);
    shade(input, 0.0, measured);
    shade(input, 0.25, displaced);
    printf("%s, red, lights along the circle of the viewer\ntheta_i   as measured   displaced\n", input);
    for (int k = 0; k < COUNT; k += 111)
        printf("%7.3f   %11.5f   %9.5f\n", 1.5 * (2.0 * k / (COUNT - 1) - 1.0), (double)measured[k].fcos[0],
               (double)displaced[k].fcos[0]);
    printf("highest   %11.5f   %9.5f\n", (double)highest(measured), (double)highest(displaced));
    EXPECT(highest(displaced) < highest(measured)); /* roughness spreads a highlight */
    return EXIT_SUCCESS;
}
