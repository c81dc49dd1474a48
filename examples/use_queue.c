/* slopemix on a queue that a program has already (own_program.c): kernels of both take turns on the program's buffers,
 * and nothing comes back to the host but the answer, how much light the material reflects from a direction. */
#include <math.h>

#include "check.h"
#include "own_program.h"
#include "slopemix_opencl.h"

static smx_evaluator evaluator_on(const Program *p, smx_material material) {
    const smx_displacement flat = {0.0, 0.0, 0.0, 0.0, 0.0};
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    smx_context context;
    smx_evaluator evaluator;
    options.cl_context = p->context;
    options.cl_queue = p->queue;
    OK(smx_context_create(&options, &context));
    OK(smx_evaluator_create(context, material, &flat, SMX_G2_CORRELATED, NULL, &evaluator));
    smx_context_release(context); /* the evaluator keeps it */
    return evaluator;
}

/* Enqueues it all, each waiting for what was before it, and waits once: for the answer. */
static void albedo_of(Program *p, smx_evaluator evaluator, float theta_o, float albedo[3]) {
    const smx_cl_vectors u = SMX_CL_PACKED(p->buffers[U], 3), wo = SMX_CL_PACKED(p->buffers[WO], 3);
    const smx_cl_vectors wi = SMX_CL_PACKED(p->buffers[WI], 3), fcos = SMX_CL_PACKED(p->buffers[FCOS], 3);
    const smx_cl_scalars pdf = {p->buffers[PDF], 0, 1};
    const size_t count = COUNT, one = 1, size = 3 * sizeof(float);
    cl_event made, drawn, shaded, added;
    CL_OK(clSetKernelArg(p->make, 0, sizeof theta_o, &theta_o));
    CL_OK(clEnqueueNDRangeKernel(p->queue, p->make, 1, NULL, &count, NULL, 0, NULL, &made));
    OK(smx_enqueue_sample(evaluator, COUNT, &u, &wo, &wi, &pdf, 1, &made, &drawn));
    OK(smx_enqueue_eval(evaluator, COUNT, &wi, &wo, &fcos, 1, &drawn, &shaded));
    CL_OK(clEnqueueNDRangeKernel(p->queue, p->mean, 1, NULL, &one, NULL, 1, &shaded, &added));
    CL_OK(clEnqueueReadBuffer(p->queue, p->buffers[ALBEDO], CL_TRUE, 0, size, albedo, 1, &added, NULL));
    clReleaseEvent(made), clReleaseEvent(drawn), clReleaseEvent(shaded), clReleaseEvent(added);
}

/* A fitted material knows its albedo at some angles. */
static void compare(Program *p, smx_material material) {
    smx_evaluator evaluator = evaluator_on(p, material);
    double theta_o[SMX_ALBEDO_ANGLES], known[SMX_ALBEDO_ANGLES][3];
    OK(smx_material_get_albedo(material, theta_o, NULL, &known[0][0]));
    printf("theta_o   albedo, r g b           the fit's own\n");
    for (int k = 0; k < SMX_ALBEDO_ANGLES; ++k) {
        float albedo[3];
        albedo_of(p, evaluator, (float)theta_o[k], albedo);
        printf("%.3f     %.4f %.4f %.4f   %.4f %.4f %.4f\n", theta_o[k], (double)albedo[0], (double)albedo[1],
               (double)albedo[2], known[k][0], known[k][1], known[k][2]);
        for (int c = 0; c < 3; ++c) EXPECT(fabs((double)albedo[c] - known[k][c]) < 0.01 * known[k][c]);
    }
    smx_evaluator_release(evaluator);
}

int main(void) {
    Program p = make_program();
    smx_brdf brdf;
    smx_density density;
    smx_material material;
    OK(smx_brdf_open("builtin:conductor", &brdf));
    OK(smx_density_create(brdf, NULL, &density));
    OK(smx_material_fit(density, NULL, &material));
    compare(&p, material);
    smx_material_release(material);
    smx_density_release(density);
    smx_brdf_release(brdf);
    release_program(&p);
    return EXIT_SUCCESS;
}
