/* Every function of slopemix.h with a handle that was released already: INVALID_ARGUMENT, which names it; and nothing
 * is touched. (Those of slopemix_opencl.h: test_opencl_interop.cpp.) */
#include "c_objects.h"

#define RELEASED(name, call) FAILS(SMX_INVALID_ARGUMENT, name " was released", call)

static const float up[3] = {0.0f, 0.0f, 1.0f};
static const smx_displacement x = {0.1, 0.1, 0.0, 0.0, 0.0};
static const smx_scene scene = SMX_SCENE_INIT;

static void check_brdf(smx_context context) {
    const smx_brdf gone = c_brdf(), alive = c_brdf();
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    smx_baseline_report baseline = SMX_BASELINE_REPORT_INIT;
    smx_density density = (smx_density)UNTOUCHED;
    smx_image image = (smx_image)UNTOUCHED;
    double value = 0.0;
    float fcos[3];
    smx_brdf_release(gone);
    RELEASED("brdf", smx_brdf_retain(gone));
    RELEASED("brdf", smx_brdf_get_info(gone, &info));
    RELEASED("brdf", smx_brdf_get_values(gone, &value, 1));
    RELEASED("brdf", smx_brdf_write(gone, "/nowhere/at/all.binary"));
    RELEASED("brdf", smx_density_create(gone, NULL, &density));
    RELEASED("brdf", smx_brdf_compare(gone, alive, &errors));
    RELEASED("reference", smx_brdf_compare(alive, gone, &errors));
    RELEASED("brdf", smx_baseline_fit(gone, SMX_BASELINE_GGX, &baseline));
    RELEASED("brdf", smx_render_reference(context, gone, &scene, NULL, &image, NULL));
    RELEASED("brdf", smx_render_geometric(context, gone, &scene, NULL, NULL, &image, NULL));
    RELEASED("brdf", smx_brdf_eval(context, gone, SMX_LOOKUP_LINEAR, 1, up, up, fcos));
    RELEASED("brdf", smx_brdf_integrate(context, gone, &x, SMX_G2_CORRELATED, NULL, 1, up, up, fcos, NULL, NULL));
    CHECK(density == (smx_density)UNTOUCHED && image == (smx_image)UNTOUCHED);
    smx_brdf_release(gone); /* and once more does nothing */
    OK(smx_brdf_get_info(alive, &info));
    smx_brdf_release(alive);
}

static void check_density(void) {
    static const double theta[2] = {0.0, 1.0}, values[2] = {1.0, 0.5};
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    smx_density gone = NULL;
    smx_material material = (smx_material)UNTOUCHED;
    smx_brdf brdf = (smx_brdf)UNTOUCHED;
    double slope = 0.0;
    OK(smx_density_from_samples("d", SMX_DENSITY_P22, 2, theta, values, &gone));
    smx_density_release(gone);
    RELEASED("density", smx_density_retain(gone));
    RELEASED("density", smx_density_get_info(gone, &info));
    RELEASED("density", smx_density_get_nodes(gone, &slope, NULL, NULL, 1));
    RELEASED("density", smx_material_fit(gone, NULL, &material));
    RELEASED("density", smx_density_tabulate(gone, &brdf));
    CHECK(material == (smx_material)UNTOUCHED && brdf == (smx_brdf)UNTOUCHED);
    smx_density_release(gone);
}

static void check_material(smx_context context) {
    const smx_material gone = c_material();
    const smx_brdf table = c_brdf();
    smx_choose_options choose = SMX_CHOOSE_OPTIONS_INIT;
    smx_choice choice = SMX_CHOICE_INIT;
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    smx_effect_report effects = SMX_EFFECT_REPORT_INIT;
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    smx_image image = (smx_image)UNTOUCHED;
    smx_evaluator evaluator = (smx_evaluator)UNTOUCHED;
    smx_brdf brdf = (smx_brdf)UNTOUCHED;
    smx_lobe lobes[2];
    size_t count = 0;
    double values[24];
    float fcos[3];
    smx_material_release(gone);
    choose.max_error = 0.1;
    RELEASED("material", smx_material_retain(gone));
    RELEASED("material", smx_material_get_info(gone, &info));
    RELEASED("material", smx_material_get_report(gone, &report));
    RELEASED("material", smx_material_get_deviations(gone, values, NULL, 2));
    RELEASED("material", smx_material_get_albedo(gone, values, NULL, NULL));
    RELEASED("material", smx_material_get_lobes(gone, lobes, 2));
    RELEASED("material", smx_material_get_fresnel(gone, NULL, values, 6));
    RELEASED("material", smx_material_save(gone, "/nowhere/at/all.json"));
    RELEASED("material", smx_material_pack(gone, NULL, &count));
    RELEASED("material", smx_material_tabulate(gone, &brdf));
    RELEASED("material", smx_material_brdf_errors(gone, table, &errors));
    RELEASED("material", smx_material_effects(gone, &scene, NULL, &effects));
    RELEASED("material", smx_render_filtered(context, gone, &scene, NULL, &image, NULL));
    RELEASED("material", smx_material_eval(context, gone, &x, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    RELEASED("material", smx_evaluator_create(context, gone, &x, SMX_G2_CORRELATED, NULL, &evaluator));
    RELEASED("materials[0]", smx_choose(context, table, &gone, 1, &scene, NULL, &choose, &choice));
    smx_brdf_release(table);
    RELEASED("brdf", smx_choose(context, table, NULL, 0, &scene, NULL, &choose, &choice));
    CHECK(image == (smx_image)UNTOUCHED && evaluator == (smx_evaluator)UNTOUCHED && brdf == (smx_brdf)UNTOUCHED);
    smx_material_release(gone);
}

static void check_image(void) {
    const smx_image gone = c_image(2, 2), alive = c_image(2, 2);
    smx_comparison comparison = SMX_COMPARISON_INIT;
    uint32_t width = 7, height = 7;
    uint8_t rgb[12];
    double value = 0.0;
    smx_image_release(gone);
    RELEASED("image", smx_image_retain(gone));
    RELEASED("image", smx_image_get_size(gone, &width, &height));
    RELEASED("image", smx_image_set_attribute(gone, "key", "value"));
    RELEASED("image", smx_image_write_exr(gone, "/nowhere/at/all.exr"));
    RELEASED("image", smx_image_write_png(gone, "/nowhere/at/all.png", 1.0));
    RELEASED("image", smx_image_display(gone, 1.0, rgb, sizeof rgb));
    RELEASED("image", smx_image_quantile(gone, 0.5, &value));
    RELEASED("image", smx_image_compare(gone, alive, &comparison));
    RELEASED("reference", smx_image_compare(alive, gone, &comparison));
    CHECK(smx_image_pixels(gone) == NULL);
    CHECK(smx_image_errors(gone) == NULL);
    CHECK(smx_image_get_attribute(gone, "key") == NULL);
    CHECK(width == 7 && height == 7);
    smx_image_release(gone);
    smx_image_release(alive);
}

static void check_evaluator(smx_context context) {
    const smx_material material = c_material();
    const smx_vectors v = {up, up + 1, up + 2, 3};
    float values[3] = {-1.0f, -1.0f, -1.0f};
    const smx_vectors_out rgb = {values, values + 1, values + 2, 3};
    const smx_scalars_out one = {values, 1};
    smx_evaluator gone = NULL;
    double bound = 0.0;
    OK(smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, NULL, &gone));
    smx_evaluator_release(gone);
    RELEASED("evaluator", smx_evaluator_retain(gone));
    RELEASED("evaluator", smx_evaluator_build(gone, SMX_QUANTITY_ALL));
    RELEASED("evaluator", smx_evaluator_eval(gone, 1, &v, &v, &rgb));
    RELEASED("evaluator", smx_evaluator_sample(gone, 1, &v, &v, &rgb, NULL, NULL));
    RELEASED("evaluator", smx_evaluator_pdf(gone, 1, &v, &v, &one));
    RELEASED("evaluator", smx_evaluator_g2(gone, 1, &v, &v, &one));
    RELEASED("evaluator", smx_evaluator_ndf(gone, 1, &v, &one));
    RELEASED("evaluator", smx_evaluator_sigma(gone, 1, &v, &one));
    RELEASED("evaluator", smx_evaluator_g1(gone, 1, &v, &one));
    RELEASED("evaluator", smx_evaluator_sample_bound(gone, &bound));
    CHECK(values[0] == -1.0f);
    smx_evaluator_release(gone);
    smx_material_release(material);
}

static void check_context(void) {
    const smx_material material = c_material();
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    smx_image image = (smx_image)UNTOUCHED;
    smx_evaluator evaluator = (smx_evaluator)UNTOUCHED;
    smx_context gone = NULL;
    float fcos[3];
    OK(smx_context_create(NULL, &gone));
    smx_context_release(gone);
    RELEASED("context", smx_context_retain(gone));
    RELEASED("context", smx_context_get_info(gone, &info));
    RELEASED("context", smx_render_filtered(gone, material, &scene, NULL, &image, NULL));
    RELEASED("context", smx_render_geometry(gone, &scene, NULL, &image, NULL));
    RELEASED("context", smx_material_eval(gone, material, &x, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    RELEASED("context", smx_evaluator_create(gone, material, &x, SMX_G2_CORRELATED, NULL, &evaluator));
    CHECK(image == (smx_image)UNTOUCHED && evaluator == (smx_evaluator)UNTOUCHED);
    smx_context_release(gone);
    smx_material_release(material);
}

/* An address comes back only after many others have been released. */
static void check_addresses(void) {
    const smx_image gone = c_image(2, 2);
    int k, came_back = 0;
    smx_image_release(gone);
    for (k = 0; k < 255; ++k) {
        const smx_image other = c_image(2, 2);
        came_back += other == gone;
        smx_image_release(other);
    }
    CHECK(came_back == 0);
    CHECK(smx_image_pixels(gone) == NULL);
}

int main(void) {
    smx_context context = NULL;
    OK(smx_context_create(NULL, &context));
    check_brdf(context);
    check_density();
    check_material(context);
    check_image();
    check_evaluator(context);
    check_context();
    check_addresses();
    smx_context_release(context);
    return c_check_result();
}
