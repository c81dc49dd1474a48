/* smx_render_*, smx_material_eval, smx_brdf_eval and smx_brdf_integrate with every bad argument. */
#include "c_objects.h"

static smx_context context;
static smx_brdf brdf;
static smx_material material;

/* Which of the three renderers; all check the same scene and options. */
enum { FILTERED, REFERENCE, GEOMETRY, RENDERERS };

static smx_status render(int which, const smx_scene *scene, const smx_render_options *options, smx_image *image,
                         smx_render_report *report) {
    if (which == FILTERED) return smx_render_filtered(context, material, scene, options, image, report);
    if (which == REFERENCE) return smx_render_reference(context, brdf, scene, options, image, report);
    return smx_render_geometry(context, scene, options, image, report);
}

/* A scene that every renderer must refuse with a message that has `needle`. */
static void refuse_scene(const char *needle, const smx_scene *scene) {
    int which;
    for (which = 0; which < RENDERERS; ++which) {
        smx_image image = (smx_image)UNTOUCHED;
        smx_render_report report = SMX_RENDER_REPORT_INIT;
        report.seconds = -7.0;
        INVALID(needle, render(which, scene, NULL, &image, &report));
        CHECK(image == (smx_image)UNTOUCHED && report.seconds == -7.0);
    }
}

static void check_scene(void) {
    const size_t sizes[] = WRONG_SIZES(smx_scene);
    static const double not_finite[] = {NAN, INFINITY, -INFINITY};
    const smx_scene good = SMX_SCENE_INIT;
    smx_scene bad = good;
    size_t k;
    refuse_scene("scene", NULL);
    for (k = 0; k < 5; ++k) {
        bad.size = sizes[k];
        refuse_scene("size", &bad);
    }
    bad = good;
    bad.width = 0;
    refuse_scene("width", &bad);
    bad.width = 16385;
    refuse_scene("16385", &bad);
    bad = good;
    bad.height = 0;
    refuse_scene("height", &bad);
    bad.height = UINT32_MAX;
    refuse_scene("4294967295", &bad);
    bad = good;
    bad.masking = (smx_masking)2;
    refuse_scene("masking", &bad);
    for (k = 0; k < 3; ++k) {
        bad = good;
        bad.light_phi = not_finite[k];
        refuse_scene("light_phi", &bad);
    }
}

/* Displacements out of range: the field that is wrong is named. */
static void check_displacement(void) {
    static const double bad_alphas[] = {-1e-9, -1.0, 10001.0, NAN, INFINITY, -INFINITY};
    static const double bad_rhos[] = {1.0, -1.0, 2.0, NAN, INFINITY};
    static const double bad_slopes[] = {10001.0, -10001.0, NAN, INFINITY, -INFINITY};
    const smx_scene good = SMX_SCENE_INIT;
    smx_scene bad = good;
    size_t k;
    for (k = 0; k < sizeof bad_alphas / sizeof *bad_alphas; ++k) {
        bad = good;
        bad.displacement.alpha_x = bad_alphas[k];
        refuse_scene("alpha_x", &bad);
        bad = good;
        bad.displacement.alpha_y = bad_alphas[k];
        refuse_scene("alpha_y", &bad);
    }
    for (k = 0; k < sizeof bad_rhos / sizeof *bad_rhos; ++k) {
        bad = good;
        bad.displacement.rho = bad_rhos[k];
        refuse_scene("rho", &bad);
    }
    for (k = 0; k < sizeof bad_slopes / sizeof *bad_slopes; ++k) {
        bad = good;
        bad.displacement.mean_slope_x = bad_slopes[k];
        refuse_scene("mean_slope_x", &bad);
        bad = good;
        bad.displacement.mean_slope_y = bad_slopes[k];
        refuse_scene("mean_slope_y", &bad);
    }
    bad = good;
    bad.displacement.alpha_x = -0.25;
    refuse_scene("-0.25", &bad);
}

/* The same of a sum, which has a range of its own. */
static void check_displacement_add(void) {
    const smx_displacement x = {0.3, 0.0, 0.0, 0.5, 0.0}, y = {0.4, 0.2, 0.5, -1.0, 2.0};
    smx_displacement sum = {-7.0, 0.0, 0.0, 0.0, 0.0}, bad = x;
    INVALID("x is null", smx_displacement_add(NULL, &y, &sum));
    INVALID("y is null", smx_displacement_add(&x, NULL, &sum));
    INVALID("sum is null", smx_displacement_add(&x, &y, NULL));
    bad.rho = 1.0;
    INVALID("rho is 1", smx_displacement_add(&bad, &y, &sum));
    INVALID("rho is 1", smx_displacement_add(&x, &bad, &sum));
    bad = x;
    bad.alpha_x = 9e3;
    INVALID("alpha_x is 12727", smx_displacement_add(&bad, &bad, &sum));
    bad = x;
    bad.mean_slope_y = -9e3;
    INVALID("mean_slope_y is -18000", smx_displacement_add(&bad, &bad, &sum));
    CHECK(sum.alpha_x == -7.0);
    OK(smx_displacement_add(&x, &y, &sum));
    CHECK(sum.alpha_x == 0.5 && sum.alpha_y == 0.2);
    CHECK(sum.mean_slope_x == -0.5 && sum.mean_slope_y == 2.0);
    CHECK(fabs(sum.rho - 0.4) < 1e-15);
}

static void check_options(void) {
    const size_t sizes[] = WRONG_SIZES(smx_render_options);
    const smx_scene scene = SMX_SCENE_INIT;
    const smx_render_options good = SMX_RENDER_OPTIONS_INIT;
    smx_render_options bad = good;
    smx_image image = (smx_image)UNTOUCHED;
    size_t k;
    int which;
    for (k = 0; k < 5; ++k) {
        bad.size = sizes[k];
        for (which = 0; which < RENDERERS; ++which) INVALID("size", render(which, &scene, &bad, &image, NULL));
    }
    bad = good;
    bad.spp = 0;
    INVALID("spp", render(REFERENCE, &scene, &bad, &image, NULL));
    bad.sampler = SMX_SAMPLER_GRID;
    bad.spp = 2;
    INVALID("square", render(REFERENCE, &scene, &bad, &image, NULL));
    bad.spp = 65535;
    INVALID("65535", render(REFERENCE, &scene, &bad, &image, NULL));
    bad.spp = 4097 * 4097;
    INVALID("16785409", render(REFERENCE, &scene, &bad, &image, NULL));
    bad = good;
    bad.sampler = SMX_SAMPLER_MIS;
    bad.spp = 4095;
    INVALID("4095", render(REFERENCE, &scene, &bad, &image, NULL));
    for (k = 0; k < 4; ++k) {
        static const double targets[] = {-0.1, 1.1, NAN, INFINITY};
        bad = good;
        bad.sampler = SMX_SAMPLER_SOBOL;
        bad.target_error = targets[k];
        INVALID("target_error", render(REFERENCE, &scene, &bad, &image, NULL));
    }
    bad = good;
    bad.sampler = SMX_SAMPLER_GRID;
    bad.target_error = 0.01; /* the grid has no estimate to stop by */
    INVALID("target_error", render(REFERENCE, &scene, &bad, &image, NULL));
    bad.target_error = 0.0;
    bad.errors = 1; /* nor one to keep */
    INVALID("errors", render(REFERENCE, &scene, &bad, &image, NULL));
    bad.sampler = SMX_SAMPLER_SOBOL;
    bad.spp = 1000;
    INVALID("1000", render(REFERENCE, &scene, &bad, &image, NULL));
    bad.spp = 48; /* a multiple of 16 */
    bad.scrambles = 16;
    INVALID("multiple of 32", render(REFERENCE, &scene, &bad, &image, NULL));
    for (k = 0; k < 5; ++k) {
        static const uint32_t counts[] = {0, 1, 9, 24, 128};
        bad = good;
        bad.scrambles = counts[k];
        INVALID("8, 16, 32 or 64", render(REFERENCE, &scene, &bad, &image, NULL));
    }
    bad = good;
    bad.exr_path = "";
    for (which = 0; which < RENDERERS; ++which) INVALID("exr_path", render(which, &scene, &bad, NULL, NULL));
    bad.exr_path = "x.exr"; /* two places for one image */
    for (which = 0; which < RENDERERS; ++which) INVALID("image", render(which, &scene, &bad, &image, NULL));
    bad = good;
    bad.sampler = (smx_sampler)77;
    INVALID("sampler", render(REFERENCE, &scene, &bad, &image, NULL));
    bad = good;
    bad.lookup = (smx_lookup)2;
    INVALID("lookup", render(REFERENCE, &scene, &bad, &image, NULL));
    CHECK(image == (smx_image)UNTOUCHED);
}

static void check_widening(void) {
    static const int orders[] = {-2, 9, INT32_MAX, INT32_MIN};
    static const double tolerances[] = {0.0, 1.0, -0.1, NAN, INFINITY};
    const smx_displacement x = {0.1, 0.1, 0.0, 0.0, 0.0};
    const smx_scene scene = SMX_SCENE_INIT;
    const smx_render_options good = SMX_RENDER_OPTIONS_INIT;
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float fcos[3] = {-7.0f, -7.0f, -7.0f};
    smx_render_options bad = good;
    smx_image image = (smx_image)UNTOUCHED;
    size_t k;
    for (k = 0; k < sizeof orders / sizeof *orders; ++k) {
        bad.widening_order = orders[k];
        INVALID("widening_order", render(FILTERED, &scene, &bad, &image, NULL));
        INVALID("widening_order", smx_material_eval(context, material, &x, SMX_G2_CORRELATED, &bad, 1, up, up, fcos));
    }
    bad.widening_order = 9;
    INVALID("is 9; it must be 0..8", render(FILTERED, &scene, &bad, &image, NULL));
    bad = good;
    bad.widening_order = SMX_WIDENING_AUTO;
    for (k = 0; k < sizeof tolerances / sizeof *tolerances; ++k) {
        bad.widening_tolerance = tolerances[k];
        INVALID("widening_tolerance", render(FILTERED, &scene, &bad, &image, NULL));
    }
    bad.widening_tolerance = good.widening_tolerance; /* pairs have no image to choose by */
    INVALID("auto", smx_material_eval(context, material, &x, SMX_G2_CORRELATED, &bad, 1, up, up, fcos));
    bad.size = sizeof bad - 1;
    INVALID("size", smx_material_eval(context, material, &x, SMX_G2_CORRELATED, &bad, 1, up, up, fcos));
    CHECK(image == (smx_image)UNTOUCHED && fcos[0] == -7.0f && fcos[1] == -7.0f && fcos[2] == -7.0f);
    bad = good;
    bad.widening_order = SMX_WIDENING_MAX_ORDER;
    OK(smx_material_eval(context, material, &x, SMX_G2_CORRELATED, &bad, 1, up, up, fcos));
    CHECK(fcos[0] > 0.0f && fcos[2] > 0.0f);
}

static void check_handles(void) {
    const size_t sizes[] = WRONG_SIZES(smx_render_report);
    const smx_scene scene = SMX_SCENE_INIT;
    smx_image image = (smx_image)UNTOUCHED;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    size_t k;
    int which;
    INVALID("context", smx_render_filtered(NULL, material, &scene, NULL, &image, NULL));
    INVALID("material", smx_render_filtered(context, NULL, &scene, NULL, &image, NULL));
    INVALID("context", smx_render_reference(NULL, brdf, &scene, NULL, &image, NULL));
    INVALID("brdf", smx_render_reference(context, NULL, &scene, NULL, &image, NULL));
    INVALID("context", smx_render_geometry(NULL, &scene, NULL, &image, NULL));
    for (which = 0; which < RENDERERS; ++which) {
        INVALID("image", render(which, &scene, NULL, NULL, NULL));
        for (k = 0; k < 5; ++k) {
            report.size = sizes[k];
            INVALID("size", render(which, &scene, NULL, &image, &report));
        }
    }
    CHECK(image == (smx_image)UNTOUCHED);
}

static int stop(void *user, double share) {
    ++*(int *)user;
    return share >= 0.0;
}

static void check_cancel(void) {
    smx_scene scene = SMX_SCENE_INIT;
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    int which;
    scene.displacement.alpha_x = scene.displacement.alpha_y = 0.25;
    options.progress = stop;
    for (which = 0; which < RENDERERS; ++which) {
        smx_image image = (smx_image)UNTOUCHED;
        int calls = 0;
        options.progress_user = &calls;
        FAILS(SMX_CANCELLED, "", render(which, &scene, &options, &image, NULL));
        CHECK(calls == 1 && image == (smx_image)UNTOUCHED);
    }
}

static void check_eval(void) {
    const smx_displacement x = {0.1, 0.1, 0.0, 0.0, 0.0};
    smx_displacement bad = x;
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float fcos[3] = {-7.0f, -7.0f, -7.0f};
    INVALID("context", smx_material_eval(NULL, material, &x, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    INVALID("material", smx_material_eval(context, NULL, &x, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    INVALID("displacement", smx_material_eval(context, material, NULL, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    INVALID("wi", smx_material_eval(context, material, &x, SMX_G2_CORRELATED, NULL, 1, NULL, up, fcos));
    INVALID("wo", smx_material_eval(context, material, &x, SMX_G2_CORRELATED, NULL, 1, up, NULL, fcos));
    INVALID("fcos", smx_material_eval(context, material, &x, SMX_G2_CORRELATED, NULL, 1, up, up, NULL));
    INVALID("masking", smx_material_eval(context, material, &x, (smx_masking)7, NULL, 1, up, up, fcos));
    bad.rho = 1.0;
    INVALID("rho", smx_material_eval(context, material, &bad, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    bad = x;
    bad.alpha_y = NAN;
    INVALID("alpha_y", smx_material_eval(context, material, &bad, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    CHECK(fcos[0] == -7.0f && fcos[1] == -7.0f && fcos[2] == -7.0f);
    OK(smx_material_eval(context, material, &x, SMX_G2_CORRELATED, NULL, 1, up, up, fcos));
    CHECK(fcos[0] > 0.0f && fcos[2] > 0.0f);
}

static void check_brdf_eval(void) {
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float f[3] = {-7.0f, -7.0f, -7.0f};
    INVALID("context", smx_brdf_eval(NULL, brdf, SMX_LOOKUP_LINEAR, 1, up, up, f));
    INVALID("brdf", smx_brdf_eval(context, NULL, SMX_LOOKUP_LINEAR, 1, up, up, f));
    INVALID("wi", smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, 1, NULL, up, f));
    INVALID("wo", smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, 1, up, NULL, f));
    INVALID("f is null", smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, 1, up, up, NULL));
    INVALID("lookup is 7", smx_brdf_eval(context, brdf, (smx_lookup)7, 1, up, up, f));
    INVALID("count", smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, SIZE_MAX, up, up, f));
    OK(smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, 0, up, up, f));
    CHECK(f[0] == -7.0f && f[1] == -7.0f && f[2] == -7.0f);
    OK(smx_brdf_eval(context, brdf, SMX_LOOKUP_LINEAR, 1, up, up, f));
    CHECK(f[0] > 0.0f && f[2] > 0.0f);
}

static void check_integrate(void) {
    const smx_displacement x = {0.1, 0.1, 0.0, 0.0, 0.0};
    const size_t sizes[] = WRONG_SIZES(smx_render_options);
    smx_displacement bad = x;
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float f[3] = {-7.0f, -7.0f, -7.0f}, e[3] = {-7.0f, -7.0f, -7.0f};
    const smx_masking g = SMX_G2_CORRELATED;
    int calls = 0;
    size_t k;
    INVALID("context", smx_brdf_integrate(NULL, brdf, &x, g, NULL, 1, up, up, f, e, NULL));
    INVALID("brdf", smx_brdf_integrate(context, NULL, &x, g, NULL, 1, up, up, f, e, NULL));
    INVALID("displacement", smx_brdf_integrate(context, brdf, NULL, g, NULL, 1, up, up, f, e, NULL));
    INVALID("wi", smx_brdf_integrate(context, brdf, &x, g, NULL, 1, NULL, up, f, e, NULL));
    INVALID("wo", smx_brdf_integrate(context, brdf, &x, g, NULL, 1, up, NULL, f, e, NULL));
    INVALID("fcos", smx_brdf_integrate(context, brdf, &x, g, NULL, 1, up, up, NULL, e, NULL));
    INVALID("masking is 7", smx_brdf_integrate(context, brdf, &x, (smx_masking)7, NULL, 1, up, up, f, e, NULL));
    INVALID("count", smx_brdf_integrate(context, brdf, &x, g, NULL, SIZE_MAX, up, up, f, e, NULL));
    bad.rho = 1.0;
    INVALID("rho", smx_brdf_integrate(context, brdf, &bad, g, NULL, 1, up, up, f, e, NULL));
    for (k = 0; k < 5; ++k) {
        options.size = sizes[k];
        INVALID("size", smx_brdf_integrate(context, brdf, &x, g, &options, 1, up, up, f, e, NULL));
    }
    options.size = sizeof options;
    options.sampler = SMX_SAMPLER_GRID;
    INVALID("errors", smx_brdf_integrate(context, brdf, &x, g, &options, 1, up, up, f, e, NULL));
    options.sampler = SMX_SAMPLER_SOBOL;
    options.exr_path = "x.exr";
    INVALID("x.exr", smx_brdf_integrate(context, brdf, &x, g, &options, 1, up, up, f, e, NULL));
    options.exr_path = NULL;
    report.size = 0;
    INVALID("report", smx_brdf_integrate(context, brdf, &x, g, &options, 1, up, up, f, e, &report));
    options.progress = stop;
    options.progress_user = &calls;
    FAILS(SMX_CANCELLED, "", smx_brdf_integrate(context, brdf, &x, g, &options, 1, up, up, f, e, NULL));
    CHECK(calls == 1);
    options.progress = NULL;
    OK(smx_brdf_integrate(context, brdf, &x, g, &options, 0, up, up, f, e, NULL));
    for (k = 0; k < 3; ++k) CHECK(f[k] == -7.0f && e[k] == -7.0f);
    OK(smx_brdf_integrate(context, brdf, &x, g, &options, 1, up, up, f, NULL, NULL));
    CHECK(f[0] > 0.0f && f[2] > 0.0f);
}

/* Images and contexts live on when what made them is released. */
static void check_release_order(void) {
    smx_scene scene = SMX_SCENE_INIT;
    smx_context other = NULL;
    smx_image image = NULL;
    scene.width = scene.height = 8;
    OK(smx_context_create(NULL, &other));
    OK(smx_render_filtered(other, material, &scene, NULL, &image, NULL));
    smx_context_release(other);
    CHECK(smx_image_pixels(image) != NULL);
    smx_image_release(image);
}

int main(void) {
    OK(smx_context_create(NULL, &context));
    brdf = c_brdf();
    material = c_material();
    check_scene();
    check_displacement();
    check_displacement_add();
    check_options();
    check_widening();
    check_handles();
    check_cancel();
    check_eval();
    check_brdf_eval();
    check_integrate();
    check_release_order();
    smx_image_release(NULL);
    smx_material_release(material);
    smx_brdf_release(brdf);
    smx_context_release(context);
    return c_check_result();
}
