/* What the library says to mistakes, and what a program does about it. */
#include <string.h>

#include "check.h"

/* A mistake that must be told: by this status, with a message that has this word. */
static void mistake(const char *what, smx_status status, smx_status wanted, const char *word) {
    printf("%s\n    %s (%d): %s\n    \"%s\"\n", what, smx_status_name(status), (int)status, smx_status_text(status),
           smx_last_error());
    EXPECT(status == wanted);
    EXPECT(strstr(smx_last_error(), word) != NULL);
}

/* Stops what it is told of at a tenth. */
static int stop_early(void *calls, double share) {
    ++*(int *)calls;
    return share >= 0.1;
}

static void check_arguments(smx_brdf brdf) {
    smx_brdf untouched = brdf;
    smx_density density = NULL;
    smx_inversion_options options = SMX_INVERSION_OPTIONS_INIT;
    mistake("A file that is not there", smx_brdf_open("no-such.binary", &untouched), SMX_CANNOT_READ, "no-such.binary");
    EXPECT(untouched == brdf); /* a call that fails leaves its outputs as they were */
    mistake("A material that does not exist", smx_brdf_open("builtin:unobtainium", &untouched), SMX_INVALID_ARGUMENT,
            "unobtainium");
    options.tolerance = -1.0;
    mistake("A value out of its range", smx_density_create(brdf, &options, &density), SMX_INVALID_ARGUMENT,
            "tolerance");
    memset(&options, 0, sizeof options);
    mistake("Options that were never initialised", smx_density_create(brdf, &options, &density), SMX_INVALID_ARGUMENT,
            "size");
    mistake("A null pointer", smx_density_create(brdf, NULL, NULL), SMX_INVALID_ARGUMENT, "density");
    EXPECT(density == NULL);
}

static void check_device(void) {
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    smx_context context = NULL;
    options.device = "a device of next year";
    mistake("A device that is not here", smx_context_create(&options, &context), SMX_NO_DEVICE, "next year");
}

/* A call that the caller stops is an error too, and says so. */
static void check_cancel(smx_brdf brdf) {
    const smx_scene scene = SMX_SCENE_INIT;
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    smx_context context;
    smx_image image = NULL;
    int calls = 0;
    OK(smx_context_create(NULL, &context));
    options.spp = 256;
    options.progress = stop_early;
    options.progress_user = &calls;
    mistake("A rendering that was stopped", smx_render_reference(context, brdf, &scene, &options, &image, NULL),
            SMX_CANCELLED, "");
    EXPECT(calls > 0 && image == NULL);

    /* The context is as good as before. */
    options.progress = NULL;
    options.spp = 16;
    OK(smx_render_reference(context, brdf, &scene, &options, &image, NULL));
    smx_image_release(image);
    smx_context_release(context);
}

int main(void) {
    smx_brdf brdf;
    OK(smx_brdf_open("builtin:conductor", &brdf));
    check_arguments(brdf);
    check_device();
    check_cancel(brdf);
    smx_brdf_release(brdf);
    smx_brdf_release(NULL); /* legal, as free(NULL) is */
    return EXIT_SUCCESS;
}
