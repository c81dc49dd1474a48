#include "studio.h"

#include <string.h>

#include "check.h"

static const char *const names[STUDIO_MATERIALS] = {"black-phenolic", "blue-acrylic", "brass",        "chrome",
                                                    "gold-paint",     "red-fabric",   "red-phenolic", "white-marble"};

void load_materials(const char *folder, smx_material materials[STUDIO_MATERIALS]) {
    for (int k = 0; k < STUDIO_MATERIALS; ++k) {
        char path[4096];
        const int length = snprintf(path, sizeof path, "%s/%s.json", folder, names[k]);
        EXPECT(length > 0 && (size_t)length < sizeof path);
        OK(smx_material_load(path, &materials[k]));
    }
}

/* Packs all materials into one array, and tells where each begins. */
static void pack(const smx_material materials[STUDIO_MATERIALS], Studio *studio, int at[STUDIO_MATERIALS]) {
    size_t counts[STUDIO_MATERIALS];
    studio->word_count = 0;
    for (int k = 0; k < STUDIO_MATERIALS; ++k) {
        OK(smx_material_pack(materials[k], NULL, &counts[k]));
        at[k] = (int)studio->word_count;
        studio->word_count += counts[k];
    }
    studio->words = malloc(studio->word_count * sizeof(float));
    EXPECT(studio->words != NULL);
    for (int k = 0; k < STUDIO_MATERIALS; ++k) OK(smx_material_pack(materials[k], studio->words + at[k], &counts[k]));
}

/* On the floor. */
static Sphere *add_sphere(Studio *studio, float x, float y, float radius, int material) {
    Sphere *sphere = &studio->spheres[studio->sphere_count++];
    *sphere = (Sphere){x, y, radius, radius, 0.0f, 0.0f, 0.0f, material};
    return sphere;
}

/* A material as it was measured, and on a surface that is rough below the pixel. */
static void add_pair(Studio *studio, float x, float y, float radius, int material) {
    const float apart = radius * 1.06f;
    Sphere *rough;
    add_sphere(studio, x - apart, y, radius, material);
    rough = add_sphere(studio, x + apart, y, radius, material);
    rough->alpha_x = rough->alpha_y = 0.35f;
}

static void add_spheres(Studio *studio, const int at[STUDIO_MATERIALS]) {
    Sphere *sphere;
    add_pair(studio, -2.9f, -0.9f, 0.62f, at[BLUE_ACRYLIC]);
    add_pair(studio, 0.0f, -1.4f, 0.62f, at[CHROME]);
    add_pair(studio, 2.9f, -0.9f, 0.62f, at[RED_PHENOLIC]);

    /* From smooth to rough in one sphere, and rough along one axis alone. */
    sphere = add_sphere(studio, 0.0f, 1.3f, 1.3f, at[BRASS]);
    sphere->alpha_right = 0.6f;
    sphere = add_sphere(studio, 3.2f, 1.5f, 1.05f, at[CHROME]);
    sphere->alpha_y = 0.4f;
    add_sphere(studio, -3.2f, 1.5f, 1.05f, at[GOLD_PAINT]);
    add_sphere(studio, -1.5f, -2.7f, 0.36f, at[RED_FABRIC]);
    add_sphere(studio, 1.5f, -2.7f, 0.36f, at[WHITE_MARBLE]);
}

static void add_lamps(Studio *studio) {
    studio->lamps[0] = (Lamp){-6.0f, -5.0f, 5.0f, 0.0f, 3.0f, 3.0f, 3.5f, -1.0f, 1.0f, 22.0f, 19.0f, 16.0f};
    studio->lamps[1] = (Lamp){7.5f, 4.0f, 0.5f, -0.8f, -3.0f, 0.0f, 0.0f, 0.0f, 4.0f, 6.0f, 8.0f, 11.0f};
    studio->lamps[2] = (Lamp){-5.0f, 9.0f, 2.0f, 10.0f, 0.0f, 0.0f, 0.0f, -1.0f, 5.0f, 6.0f, 6.0f, 6.0f};
    studio->lamp_count = STUDIO_LAMPS;
    for (const Lamp *l = studio->lamps; l < studio->lamps + STUDIO_LAMPS; ++l)
        EXPECT(l->ux * l->vx + l->uy * l->vy + l->uz * l->vz == 0.0f);
}

static void add_camera(Studio *studio, float aspect) {
    const float half = 0.225f;                      /* tangent of half the angle from bottom to top */
    const float ahead_y = 0.88f, ahead_z = -0.475f; /* of length 1 */
    studio->camera = (Camera){0.0f, -10.5f,          6.3f,           half * aspect, 0.0f,    0.0f,
                              0.0f, -half * ahead_z, half * ahead_y, 0.0f,          ahead_y, ahead_z};
}

void make_studio(const smx_material materials[STUDIO_MATERIALS], float aspect, Studio *studio) {
    int at[STUDIO_MATERIALS];
    memset(studio, 0, sizeof *studio);
    pack(materials, studio, at);
    add_spheres(studio, at);
    studio->floor_material = at[BLACK_PHENOLIC];
    studio->tile_alpha = 0.25f;
    add_lamps(studio);
    add_camera(studio, aspect);
}

void free_studio(Studio *studio) { free(studio->words); }
