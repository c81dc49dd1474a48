/* Renders a fitted material on a displaced sphere, and the measured table on the same, as sphere.exr and .png and
 * sphere-reference.exr and .png, and compares both:
 *     render_sphere [TABLE.binary | builtin:NAME | analytic:...] */
#include "check.h"

enum { SIDE = 128 };

static smx_material fitted(smx_brdf brdf) {
    smx_density density;
    smx_material material;
    OK(smx_density_create(brdf, NULL, &density));
    OK(smx_material_fit(density, NULL, &material));
    smx_density_release(density);
    return material;
}

/* Light from the right; the surface is as rough along both axes. */
static smx_scene scene_of(double alpha) {
    smx_scene scene = SMX_SCENE_INIT;
    scene.width = scene.height = SIDE;
    scene.light_phi = 0.7853981633974483;
    scene.displacement.alpha_x = scene.displacement.alpha_y = alpha;
    return scene;
}

/* Pictures that are to be compared need the same exposure. */
static void write(smx_image image, const char *exr, const char *png, double exposure) {
    OK(smx_image_write_exr(image, exr));
    OK(smx_image_write_png(image, png, exposure));
    printf("%s, %s\n", exr, png);
}

/* The file holds what the image does, to the bit. */
static void check_file(const char *exr, smx_image image) {
    smx_image again;
    smx_comparison comparison = SMX_COMPARISON_INIT;
    OK(smx_image_read_exr(exr, &again));
    OK(smx_image_compare(again, image, &comparison));
    EXPECT(comparison.max_error == 0.0);
    smx_image_release(again);
}

int main(int argc, char **argv) {
    const smx_scene scene = scene_of(0.25);
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    smx_render_report fast = SMX_RENDER_REPORT_INIT, slow = SMX_RENDER_REPORT_INIT;
    smx_comparison comparison = SMX_COMPARISON_INIT;
    smx_brdf brdf;
    smx_material material;
    smx_context context;
    smx_image filtered, reference;
    double brightest;
    OK(smx_brdf_open(argc > 1 ? argv[1] : "builtin:two-layer", &brdf));
    material = fitted(brdf);
    OK(smx_context_create(NULL, &context));

    /* One evaluation per pixel, and integration over the surface's facets. */
    options.spp = 1024;
    OK(smx_render_filtered(context, material, &scene, &options, &filtered, &fast));
    OK(smx_render_reference(context, brdf, &scene, &options, &reference, &slow));
    OK(smx_image_quantile(reference, 0.99, &brightest));
    EXPECT(brightest > 0.0);
    write(filtered, "sphere.exr", "sphere.png", 1.0 / brightest);
    write(reference, "sphere-reference.exr", "sphere-reference.png", 1.0 / brightest);

    OK(smx_image_compare(filtered, reference, &comparison));
    printf("relRMSE %.3f of the filtered image; the reference's standard error is %.4f\n", comparison.relrmse,
           slow.standard_error);
    printf("the reference took %.0f times as long on the device\n", slow.kernel_seconds / fast.kernel_seconds);
    check_file("sphere.exr", filtered);
    EXPECT(comparison.relrmse < 0.15 && slow.standard_error < 0.02);

    smx_image_release(filtered);
    smx_image_release(reference);
    smx_context_release(context);
    smx_material_release(material);
    smx_brdf_release(brdf);
    return EXIT_SUCCESS;
}
