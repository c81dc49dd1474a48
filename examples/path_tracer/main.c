/* Renders spheres and a floor of fitted materials: NAME.exr and NAME.png. */
#include <errno.h>
#include <string.h>

#include "check.h"
#include "trace.h"

typedef struct {
    TraceOptions trace;
    const char *output;
} Arguments;

static void usage(const char *wrong, const char *value) {
    fprintf(
        stderr,
        "path_tracer: %s%s\n"
        "usage: path_tracer [--samples N] [--size WIDTHxHEIGHT] [--sampling lobes|cosine] [--seed N] [--output NAME]\n"
        "  N samples per pixel, 16..1048576, a multiple of 16; sides 1..4096\n",
        wrong, value);
    exit(2);
}

/* The integer that the text begins with, in a range; `end` is what follows it. */
static int integer(const char *flag, const char *text, int least, int most, const char **end) {
    char *after;
    long value;
    errno = 0;
    value = strtol(text, &after, 10);
    if (after == text || errno || value < least || value > most) usage(flag, text);
    *end = after;
    return (int)value;
}

static int whole_integer(const char *flag, const char *text, int least, int most) {
    const char *end;
    const int value = integer(flag, text, least, most, &end);
    if (*end) usage(flag, text);
    return value;
}

static void read_size(const char *text, TraceOptions *o) {
    const char *end;
    o->width = integer("--size cannot be ", text, 1, 4096, &end);
    if (*end != 'x') usage("--size cannot be ", text);
    o->height = whole_integer("--size cannot be ", end + 1, 1, 4096);
}

static void read_flag(const char *flag, const char *value, Arguments *a) {
    if (!value) usage(flag, " needs a value");
    if (!strcmp(flag, "--samples")) {
        a->trace.samples = whole_integer("--samples cannot be ", value, PASSES, 1 << 20);
        if (a->trace.samples % PASSES) usage("--samples cannot be ", value);
    } else if (!strcmp(flag, "--size")) {
        read_size(value, &a->trace);
    } else if (!strcmp(flag, "--seed")) {
        a->trace.seed = whole_integer("--seed cannot be ", value, 0, 0x7fffffff);
    } else if (!strcmp(flag, "--output")) {
        a->output = value;
    } else if (!strcmp(flag, "--sampling")) {
        a->trace.by_cosine = !strcmp(value, "cosine");
        if (!a->trace.by_cosine && strcmp(value, "lobes")) usage("--sampling cannot be ", value);
    } else {
        usage("there is no flag ", flag);
    }
}

/* Writes NAME and an ending. The picture's exposure leaves but the brightest thousandth of its values to clip. */
static void write_image(smx_image image, const char *name) {
    char path[4096];
    double brightest;
    EXPECT(strlen(name) + 5 <= sizeof path);
    sprintf(path, "%s.exr", name);
    OK(smx_image_write_exr(image, path));
    sprintf(path, "%s.png", name);
    OK(smx_image_quantile(image, 0.99, &brightest));
    OK(smx_image_write_png(image, path, brightest > 0.0 ? 1.0 / brightest : 1.0));
    printf("%s.exr and %s.png\n", name, name);
}

static void save(const Estimate *e, const TraceOptions *o, const char *name) {
    const size_t pixels = (size_t)o->width * (size_t)o->height;
    float *rgba = malloc(pixels * 4 * sizeof(float));
    smx_image image;
    EXPECT(rgba != NULL);
    for (size_t k = 0; k < pixels; ++k) {
        for (size_t c = 0; c < 3; ++c) rgba[4 * k + c] = (float)e->mean[3 * k + c];
        rgba[4 * k + 3] = 1.0f;
    }
    OK(smx_image_create((uint32_t)o->width, (uint32_t)o->height, rgba, &image));
    write_image(image, name);
    smx_image_release(image);
    free(rgba);
}

int main(int argc, char **argv) {
    Arguments a = {{900, 500, 64, 1, 0, 0, 8, 0.0f}, "path-tracer"};
    smx_material materials[STUDIO_MATERIALS];
    Studio studio;
    Estimate estimate;
    for (int k = 1; k < argc; k += 2) read_flag(argv[k], argv[k + 1], &a);
    load_materials(PATH_TRACER_FOLDER "/materials", materials);
    make_studio(materials, (float)a.trace.width / (float)a.trace.height, &studio);
    trace(&studio, &a.trace, PATH_TRACER_FOLDER, &estimate);
    save(&estimate, &a.trace, a.output);
    free_estimate(&estimate);
    free_studio(&studio);
    for (int k = 0; k < STUDIO_MATERIALS; ++k) smx_material_release(materials[k]);
    return EXIT_SUCCESS;
}
