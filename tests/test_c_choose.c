/* smx_choose with every bad argument. */
#include "c_objects.h"

static smx_context context;
static smx_brdf brdf;
static smx_material material;

static smx_status choose(const smx_choose_options *options, smx_choice *choice) {
    smx_scene scene = SMX_SCENE_INIT;
    scene.width = scene.height = 16;
    scene.displacement.alpha_x = scene.displacement.alpha_y = 0.3;
    return smx_choose(context, brdf, &material, 1, &scene, NULL, options, choice);
}

static smx_choose_options within(double max_error) {
    smx_choose_options options = SMX_CHOOSE_OPTIONS_INIT;
    options.max_error = max_error;
    return options;
}

static void check_pointers(void) {
    const smx_choose_options options = within(0.1);
    const smx_scene scene = SMX_SCENE_INIT;
    const smx_material none[1] = {NULL};
    smx_choice choice = SMX_CHOICE_INIT;
    choice.seconds = -7.0;
    INVALID("context", smx_choose(NULL, brdf, &material, 1, &scene, NULL, &options, &choice));
    INVALID("materials is null", smx_choose(context, brdf, NULL, 1, &scene, NULL, &options, &choice));
    INVALID("materials[0]", smx_choose(context, brdf, none, 1, &scene, NULL, &options, &choice));
    INVALID("scene", smx_choose(context, brdf, &material, 1, NULL, NULL, &options, &choice));
    INVALID("options", smx_choose(context, brdf, &material, 1, &scene, NULL, NULL, &choice));
    INVALID("choice", smx_choose(context, brdf, &material, 1, &scene, NULL, &options, NULL));
    INVALID("neither", smx_choose(context, NULL, NULL, 0, &scene, NULL, &options, &choice));
    INVALID("17", smx_choose(context, brdf, &material, 17, &scene, NULL, &options, &choice));
    CHECK(choice.seconds == -7.0);
}

static void check_options(void) {
    const size_t sizes[] = WRONG_SIZES(smx_choose_options);
    static const double bad_errors[] = {-0.1, 1.1, NAN, INFINITY}, bad_seconds[] = {-1.0, NAN, INFINITY};
    static const uint32_t bad_pixels[] = {0, 15, 65537};
    smx_choice choice = SMX_CHOICE_INIT;
    smx_choose_options bad;
    size_t k;
    for (k = 0; k < 5; ++k) {
        bad = within(0.1);
        bad.size = sizes[k];
        INVALID("options->size", choose(&bad, &choice));
    }
    for (k = 0; k < 4; ++k) {
        bad = within(bad_errors[k]);
        INVALID("max_error", choose(&bad, &choice));
    }
    for (k = 0; k < 3; ++k) {
        bad = within(0.0);
        bad.max_seconds = bad_seconds[k];
        INVALID("max_seconds", choose(&bad, &choice));
        bad = within(0.1);
        bad.pilot_pixels = bad_pixels[k];
        INVALID("pilot_pixels", choose(&bad, &choice));
    }
    bad = within(0.0);
    INVALID("one of them", choose(&bad, &choice));
    bad = within(0.1);
    bad.max_seconds = 1.0;
    INVALID("only one", choose(&bad, &choice));
}

static void check_scene_and_choice(void) {
    const size_t sizes[] = WRONG_SIZES(smx_choice);
    const smx_choose_options options = within(0.1);
    smx_choice choice = SMX_CHOICE_INIT;
    smx_scene bad = SMX_SCENE_INIT;
    size_t k;
    bad.width = 0;
    INVALID("width", smx_choose(context, brdf, &material, 1, &bad, NULL, &options, &choice));
    bad = (smx_scene)SMX_SCENE_INIT;
    bad.light = SMX_LIGHT_UNIFORM;
    INVALID("light", smx_choose(context, brdf, &material, 1, &bad, NULL, &options, &choice));
    for (k = 0; k < 5; ++k) {
        choice.size = sizes[k];
        INVALID("choice->size", choose(&options, &choice));
    }
}

/* A material that was fitted to nothing says nothing of its error; a table does. */
/* What is the image's alone has no say: where it goes, its errors, its effects. */
static void check_image_options(void) {
    const smx_choose_options options = within(0.2);
    smx_scene scene = SMX_SCENE_INIT;
    smx_render_options render = SMX_RENDER_OPTIONS_INIT;
    smx_choice plain = SMX_CHOICE_INIT, choice = SMX_CHOICE_INIT;
    FILE *file;
    scene.width = scene.height = 16;
    scene.displacement.alpha_x = scene.displacement.alpha_y = 0.3;
    CHECK(smx_choose(context, brdf, &material, 1, &scene, NULL, &options, &plain) == SMX_OK);
    render.exr_path = "chosen-and-not-rendered.exr";
    render.errors = 1;
    render.effects = SMX_EFFECT_FRESNEL;
    CHECK(smx_choose(context, brdf, &material, 1, &scene, &render, &options, &choice) == SMX_OK);
    CHECK(choice.picked.error == plain.picked.error);
    file = fopen(render.exr_path, "rb");
    CHECK(file == NULL);
    if (file) fclose(file);
}

static void check_unknown_fit(void) {
    const smx_choose_options options = within(0.1);
    const smx_scene scene = SMX_SCENE_INIT;
    smx_choice choice = SMX_CHOICE_INIT;
    FAILS(SMX_NO_SOLUTION, "paint", smx_choose(context, NULL, &material, 1, &scene, NULL, &options, &choice));
    OK(choose(&options, &choice));
    CHECK(choice.picked.error <= 0.1 && choice.picked.seconds > 0.0 && choice.tried_count >= 1);
    CHECK(strstr(choice.reason, "within an error of 0.1") != NULL);
}

int main(void) {
    OK(smx_context_create(NULL, &context));
    brdf = c_brdf();
    material = c_material();
    check_pointers();
    check_options();
    check_scene_and_choice();
    check_image_options();
    check_unknown_fit();
    smx_material_release(material);
    smx_brdf_release(brdf);
    smx_context_release(context);
    return c_check_result();
}
