/* Checks the path tracer: sampling by lobes and by the cosine make the same image, and lobes make it with less noise;
 * under a white sky nothing is brighter than the sky, and what reflects all light is as bright. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "trace.h"

enum { BLOCK = 8, WIDTH = 64, HEIGHT = 40, BLOCKS = WIDTH / BLOCK * HEIGHT / BLOCK * 3 };

/* Sharp lobes are found by the cosine so rarely that its noise could not be told: all is roughened by this. */
static const float roughened = 0.5f;

/* Of normal deviates one in five million is beyond it, and there are some hundreds: of blocks of 64 pixels, and
 * variances of as many times PASSES values. */
static const double most_deviation = 5.2;

/* Of sums in float over a path and a pass. */
static const double rounding = 1e-5;

static const char *folder;
static int seed = 0;

/* Each with random numbers of its own. */
static Estimate traced(const Studio *studio, float alpha, int by_cosine, int white_sky, int samples) {
    const TraceOptions options = {WIDTH, HEIGHT, samples, ++seed, by_cosine, white_sky, 8, alpha};
    Estimate e;
    trace(studio, &options, folder, &e);
    return e;
}

/* Means and variances over blocks of pixels, of one channel each. */
static void blocks_of(const Estimate *e, double mean[BLOCKS], double variance[BLOCKS]) {
    const double pixels = BLOCK * BLOCK;
    for (int b = 0; b < BLOCKS; ++b) mean[b] = variance[b] = 0.0;
    for (int k = 0; k < e->count; ++k) {
        const int pixel = k / 3, column = pixel % WIDTH / BLOCK, row = pixel / WIDTH / BLOCK;
        const int block = (row * (WIDTH / BLOCK) + column) * 3 + k % 3;
        mean[block] += e->mean[k] / pixels;
        variance[block] += e->variance[k] / (pixels * pixels);
    }
}

/* Over the blocks of a channel: channels of a path are not independent. */
static double sum(const double values[BLOCKS], int channel) {
    double all = 0.0;
    for (int b = channel; b < BLOCKS; b += 3) all += values[b];
    return all;
}

/* Two images must be the same but for noise. Frees both, and returns by how much the second's variance is larger. */
static double check_same(const char *what, Estimate first, Estimate second) {
    double a[BLOCKS], var_a[BLOCKS], b[BLOCKS], var_b[BLOCKS], most = 0.0;
    blocks_of(&first, a, var_a);
    blocks_of(&second, b, var_b);
    free_estimate(&first);
    free_estimate(&second);
    for (int c = 0; c < 3; ++c) {
        const double apart = sum(a, c) / sum(b, c) - 1.0;
        const double error = sqrt(sum(var_a, c) + sum(var_b, c)) / sum(b, c);
        printf("%s, %c: %+.2f %%, standard error %.2f %%\n", what, "RGB"[c], 100.0 * apart, 100.0 * error);
        EXPECT(error < 0.005); /* or the next line would say little */
        EXPECT(fabs(apart) < most_deviation * error);
    }
    for (int k = 0; k < BLOCKS; ++k) most = fmax(most, fabs(a[k] - b[k]) / sqrt(var_a[k] + var_b[k]));
    printf("    %.1f standard errors in the worst of %d blocks\n", most, BLOCKS);
    EXPECT(most < most_deviation);
    return sum(var_b, 1) / sum(var_a, 1);
}

static void check_studio(const Studio *studio) {
    check_same("studio, lobes against cosine", traced(studio, roughened, 0, 0, 512),
               traced(studio, roughened, 1, 0, 512));
}

static Studio studio_of_one(smx_material material) {
    smx_material materials[STUDIO_MATERIALS];
    Studio studio;
    for (int k = 0; k < STUDIO_MATERIALS; ++k) materials[k] = material;
    make_studio(materials, (float)WIDTH / HEIGHT, &studio);
    return studio;
}

static void whiten_lamps(Studio *studio) {
    for (int k = 0; k < studio->lamp_count; ++k) studio->lamps[k].r = studio->lamps[k].g = studio->lamps[k].b = 1.0f;
}

/* The largest directional albedo that the materials' files tell. */
static double largest_albedo(const smx_material materials[STUDIO_MATERIALS]) {
    double largest = 0.0, albedo[SMX_ALBEDO_ANGLES * 3];
    for (int m = 0; m < STUDIO_MATERIALS; ++m) {
        OK(smx_material_get_albedo(materials[m], NULL, NULL, albedo));
        for (int k = 0; k < SMX_ALBEDO_ANGLES * 3; ++k) largest = fmax(largest, albedo[k]);
    }
    return largest;
}

/* Under a sky of radiance 1 nothing is brighter than the whitest material is alone. */
static void check_furnace(const Studio *studio, double albedo) {
    Estimate e = traced(studio, 0.0f, 0, 1, 64);
    double mean[BLOCKS], variance[BLOCKS], most = 0.0;
    blocks_of(&e, mean, variance);
    free_estimate(&e);
    for (int k = 0; k < BLOCKS; ++k) {
        EXPECT(mean[k] < albedo + most_deviation * sqrt(variance[k]));
        most = fmax(most, mean[k]);
    }
    printf("white sky: the brightest block has %.3f, the largest albedo is %.3f\n", most, albedo);
    EXPECT(most > 0.1);
}

/* A material of one narrow lobe, whose facets reflect this share of light. */
static smx_material metal(double share) {
    const smx_lobe lobe = {1.0, 0.02};
    const double fresnel[] = {share, share, share, share, share, share};
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    smx_material material;
    desc.lobes = &lobe;
    desc.lobe_count = 1;
    desc.knots = 2;
    desc.fresnel = fresnel;
    OK(smx_material_create(&desc, &material));
    return material;
}

/* Among metals paths are long, and lobes narrower than the cosine. Before a sky that is as bright, lamps are not seen.
 */
static void check_metal(void) {
    const smx_material bright = metal(0.8);
    Studio studio = studio_of_one(bright), dark = studio;
    double gain;
    whiten_lamps(&studio);
    dark.lamp_count = 0;
    gain = check_same("metal, lobes against cosine", traced(&studio, roughened, 0, 1, 512),
                      traced(&studio, roughened, 1, 1, 512));
    printf("    variance by the cosine over that by lobes: %.1f\n", gain);
    EXPECT(gain > 4.0);
    check_same("metal, lamps against none", traced(&studio, roughened, 0, 1, 1024),
               traced(&dark, roughened, 0, 1, 1024));
    free_studio(&studio);
    smx_material_release(bright);
}

/* Where lamps are as bright as the sky, and facets reflect all light, there is nothing to be seen: what is missing to 1
 * is light that a second facet would send back. */
static void check_white(void) {
    const smx_material white = metal(1.0);
    const TraceOptions options = {WIDTH, HEIGHT, 64, 9, 0, 1, 64, 0.0f};
    Studio studio = studio_of_one(white);
    Estimate e;
    double mean[BLOCKS], variance[BLOCKS], most = 0.0, all;
    for (int k = 0; k < studio.sphere_count; ++k)
        studio.spheres[k].alpha_x = studio.spheres[k].alpha_y = studio.spheres[k].alpha_right = 0.0f;
    studio.tile_alpha = 0.0f;
    whiten_lamps(&studio);
    trace(&studio, &options, folder, &e);
    blocks_of(&e, mean, variance);
    for (int k = 0; k < BLOCKS; ++k) {
        EXPECT(mean[k] < 1.0 + rounding + most_deviation * sqrt(variance[k]));
        most = fmax(most, mean[k]);
    }
    all = sum(mean, 1) / (BLOCKS / 3);
    printf("white sky, lamps and materials: the brightest block has %.4f, the mean is %.4f\n", most, all);
    EXPECT(most > 0.999);
    EXPECT(all > 0.997);
    free_estimate(&e);
    free_studio(&studio);
    smx_material_release(white);
}

int main(int argc, char **argv) {
    smx_material materials[STUDIO_MATERIALS];
    Studio studio;
    char path[4096];
    EXPECT(argc == 2 && strlen(argv[1]) + 11 <= sizeof path);
    folder = argv[1];
    sprintf(path, "%s/materials", folder);
    load_materials(path, materials);
    make_studio(materials, (float)WIDTH / HEIGHT, &studio);
    check_studio(&studio);
    whiten_lamps(&studio);
    check_furnace(&studio, largest_albedo(materials));
    check_metal();
    check_white();
    free_studio(&studio);
    for (int k = 0; k < STUDIO_MATERIALS; ++k) smx_material_release(materials[k]);
    return EXIT_SUCCESS;
}
