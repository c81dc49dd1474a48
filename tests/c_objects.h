/* One object of each kind for the tests in C. */
#ifndef C_OBJECTS_H
#define C_OBJECTS_H

#include "c_check.h"

static const double c_fresnel[6] = {1.0, 1.0, 0.5, 0.5, 0.25, 0.25};

static inline smx_brdf c_brdf(void) {
    smx_brdf brdf = NULL;
    OK(smx_brdf_open("builtin:conductor", &brdf));
    return brdf;
}

static inline smx_material c_material(void) {
    const smx_lobe lobes[2] = {{0.5, 0.1}, {0.5, 0.4}};
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    smx_material material = NULL;
    desc.name = "paint";
    desc.lobes = lobes;
    desc.lobe_count = 2;
    desc.fresnel = c_fresnel;
    desc.knots = 2;
    OK(smx_material_create(&desc, &material));
    return material;
}

static inline smx_image c_image(uint32_t width, uint32_t height) {
    smx_image image = NULL;
    OK(smx_image_create(width, height, NULL, &image));
    return image;
}

#endif
