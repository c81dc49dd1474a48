/* The scene of the picture: which materials, where. */
#ifndef STUDIO_H
#define STUDIO_H

#include "scene.h"
#include "slopemix.h"

enum {
    BLACK_PHENOLIC,
    BLUE_ACRYLIC,
    BRASS,
    CHROME,
    GOLD_PAINT,
    RED_FABRIC,
    RED_PHENOLIC,
    WHITE_MARBLE,
    STUDIO_MATERIALS
};
enum { STUDIO_SPHERES = 16, STUDIO_LAMPS = 3 };

typedef struct {
    Camera camera;
    Sphere spheres[STUDIO_SPHERES];
    Lamp lamps[STUDIO_LAMPS];
    int sphere_count, lamp_count, floor_material;
    float tile_alpha;
    float *words; /* of all materials, one behind the other */
    size_t word_count;
} Studio;

/* Loads the materials from NAME.json in a folder; or ends the program. The caller releases them. */
void load_materials(const char *folder, smx_material materials[STUDIO_MATERIALS]);

/* The scene with these materials; it keeps none of them. `aspect` is the image's width over its height. */
void make_studio(const smx_material materials[STUDIO_MATERIALS], float aspect, Studio *studio);
void free_studio(Studio *studio);

#endif
