/** @file
 * The displaced surface, and the scene of an image. (Part of slopemix.h.) */
#ifndef SLOPEMIX_SCENE_H
#define SLOPEMIX_SCENE_H

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The displaced surface X: a Gaussian density of slopes. */
typedef struct smx_displacement {
    double alpha_x;      /**< finite, 0..1e4; 0 is legal in either or both */
    double alpha_y;      /**< likewise */
    double rho;          /**< correlation of the two slopes, -1 < rho < 1 */
    double mean_slope_x; /**< finite, -1e4..1e4 */
    double mean_slope_y; /**< likewise */
} smx_displacement;

/** The surface with the slopes of x and of y, which are independent, such as two scales of roughness: means and
 * covariances add, so that a material widened by the sum is one widened by x and then by y.
 *
 * @param x, y  the surfaces
 * @param sum   written; may be x or y
 * @threads   any
 * @statuses  INVALID_ARGUMENT (also a sum that is out of range) */
SMX_API smx_status smx_displacement_add(const smx_displacement *x, const smx_displacement *y, smx_displacement *sum);

/** How masking and shadowing go together. */
typedef enum smx_masking {
    SMX_G2_CORRELATED = 0, /**< height-correlated Smith */
    SMX_G2_SEPARABLE = 1   /**< G1(wi) G1(wo) */
} smx_masking;

/** What a scene is lit by. */
typedef enum smx_light {
    SMX_LIGHT_DIRECTIONAL = 0, /**< of unit perpendicular irradiance */
    SMX_LIGHT_UNIFORM = 1      /**< radiance 1 from every direction above: a furnace. Of smx_render_filtered,
                                    reference and geometric, by samples of every pixel */
} smx_light;

/** A unit sphere that fills the smaller side of the image, orthographic camera on +y looking along -y, right = +x,
 * up = +z; a directional light in the plane z = 0, or a uniform one. */
typedef struct smx_scene {
    size_t size;                   /**< sizeof(smx_scene) */
    uint32_t width;                /**< pixels, 1..16384 */
    uint32_t height;               /**< pixels, 1..16384 */
    double light_phi;              /**< finite; pi/2 is at the camera, 0 at the right, negative behind */
    smx_displacement displacement; /**< X, the sphere's roughness; x along its meridians, y along its circles */
    smx_masking masking;           /**< height-correlated, or separable */
    smx_light light;               /**< directional, or uniform */
} smx_scene;
/** Defaults of smx_scene. */
#define SMX_SCENE_INIT                                                                                 \
    {                                                                                                  \
        sizeof(smx_scene), 128, 128, 1.5707963267948966, {0.0, 0.0, 0.0, 0.0, 0.0}, SMX_G2_CORRELATED, \
            SMX_LIGHT_DIRECTIONAL                                                                      \
    }

#ifdef __cplusplus
}
#endif
#endif
