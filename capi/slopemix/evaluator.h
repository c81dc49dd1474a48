/** @file
 * A material on a displaced surface, evaluated for many directions at once. (Part of slopemix.h.) */
#ifndef SLOPEMIX_EVALUATOR_H
#define SLOPEMIX_EVALUATOR_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Arrays of the caller's, read. Element k of x is x[k * stride], and so on. Directions are unit vectors away from the
 * surface, and are not normalised. Arrays may lie in one another, as the members of an array of structs do. Where the
 * device shares the host's memory, kernels work on them in place; else they are copied
 * (smx_context_options.copy_arrays). Any number of elements may be given. */
typedef struct smx_vectors {
    const float *x; /**< of element 0 */
    const float *y; /**< likewise */
    const float *z; /**< likewise */
    size_t stride;  /**< in floats, at least 1 */
} smx_vectors;

/** Like smx_vectors, written; elements hold r, g, b where a colour is written. They may not be elements of another
 * array. */
typedef struct smx_vectors_out {
    float *x;      /**< of element 0 */
    float *y;      /**< likewise */
    float *z;      /**< likewise */
    size_t stride; /**< in floats, at least 1 */
} smx_vectors_out;

/** Like smx_vectors_out, of one float each. */
typedef struct smx_scalars_out {
    float *values; /**< element 0 */
    size_t stride; /**< in floats, at least 1 */
} smx_scalars_out;

/** Vectors that lie as [count][3]. `p` is evaluated more than once. */
#define SMX_PACKED(p) \
    { (p), (p) + 1, (p) + 2, 3 }
/** Vectors that lie as planes, [3][count]. `p` and `count` are evaluated more than once. */
#define SMX_PLANES(p, count) \
    { (p), (p) + (count), (p) + 2 * (count), 1 }

/** A material widened by X, on a context: what kernels need of both is made once. Immutable; it keeps the context
 * alive, and needs the material no more. Evaluations run on the context's first device. */
typedef struct smx_evaluator_s *smx_evaluator;

/** Makes an evaluator. Source: Dupuy 2015, chapter 5, or docs/widening.md for orders above 0.
 *
 * @param context       where it evaluates
 * @param material      what it evaluates
 * @param displacement  X, the roughness that widens every lobe
 * @param masking       height-correlated, or separable
 * @param options       grade, effects and widening_order count; SMX_WIDENING_AUTO needs an image, and SMX_EFFECTS_AUTO
 *                      is all. NULL: the defaults
 * @param evaluator     the new handle; it keeps the context alive, and needs the material no more
 * @ownership  the caller owns one reference of `*evaluator`
 * @threads    any
 * @statuses   INVALID_ARGUMENT, OUT_OF_MEMORY */
SMX_API smx_status smx_evaluator_create(smx_context context, smx_material material,
                                        const smx_displacement *displacement, smx_masking masking,
                                        const smx_render_options *options, smx_evaluator *evaluator);

/** Adds a reference.
 *
 * @param evaluator  the handle
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_evaluator_retain(smx_evaluator evaluator);

/** Drops a reference.
 *
 * @param evaluator  the handle, or NULL
 * @threads  any */
SMX_API void smx_evaluator_release(smx_evaluator evaluator);

/** What an evaluator computes; sums of these name several. */
typedef enum smx_quantity {
    SMX_QUANTITY_FCOS = 1,   /**< smx_evaluator_eval */
    SMX_QUANTITY_PDF = 2,    /**< smx_evaluator_pdf */
    SMX_QUANTITY_SAMPLE = 4, /**< smx_evaluator_sample */
    SMX_QUANTITY_NDF = 8,    /**< smx_evaluator_ndf */
    SMX_QUANTITY_SIGMA = 16, /**< smx_evaluator_sigma */
    SMX_QUANTITY_G1 = 32,    /**< smx_evaluator_g1 */
    SMX_QUANTITY_G2 = 64     /**< smx_evaluator_g2 */
} smx_quantity;
/** The sum of all. */
#define SMX_QUANTITY_ALL 127u

/** Builds kernels ahead of their first use, which would else build them: seconds where no driver has them cached.
 *
 * @param evaluator   the evaluator
 * @param quantities  a sum of smx_quantity, not 0
 * @threads   any; calls on one context run one after another
 * @statuses  INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY */
SMX_API smx_status smx_evaluator_build(smx_evaluator evaluator, uint32_t quantities);

/** f cos_i of the widened material, linear RGB, 1/sr. 0 where a direction is not above the surface and X's mean plane.
 * Returns when all is written, like all smx_evaluator_*; slopemix_opencl.h has what returns at once.
 *
 * @param evaluator  the evaluator
 * @param count      pairs of directions
 * @param wi, wo     [count] to the light, to the viewer
 * @param fcos       [count] r, g, b
 * @threads   any; calls on one context run one after another
 * @statuses  INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY; after the last three `fcos` may be
 *            half written */
SMX_API smx_status smx_evaluator_eval(smx_evaluator evaluator, size_t count, const smx_vectors *wi,
                                      const smx_vectors *wo, const smx_vectors_out *fcos);

/** Draws wi from wo: a lobe, by what wo sees of it (shared model) or by the luminance of its curves, floored
 * (per-lobe), and a facet of it among those that wo sees, about which wo is mirrored. In closed form, whatever the
 * order of widening. Source: Heitz, d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
 * Visible Normals"; docs/packed-material.md.
 *
 * @param evaluator  the evaluator
 * @param count      draws
 * @param u          [count] uniform numbers, 0 <= u < 1: x picks the lobe, y and z the facet
 * @param wo         [count] to the viewer
 * @param wi         [count] the directions drawn; some are below the surface, where f cos is 0
 * @param fcos       [count] f cos_i of the pairs, as smx_evaluator_eval has it; or NULL
 * @param pdf        [count] densities over solid angle, as smx_evaluator_pdf has them; or NULL. 0 where wo is not above
 *                   the surface and its mean plane
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_evaluator_eval */
SMX_API smx_status smx_evaluator_sample(smx_evaluator evaluator, size_t count, const smx_vectors *u,
                                        const smx_vectors *wo, const smx_vectors_out *wi, const smx_vectors_out *fcos,
                                        const smx_scalars_out *pdf);

/** Density over solid angle, 1/sr, of drawing wi from wo by smx_evaluator_sample. It integrates to 1 over all
 * directions, those below the surface included. 0 where wo is not above the surface and its mean plane.
 *
 * @param evaluator  the evaluator
 * @param count      pairs of directions
 * @param wi, wo     [count] drawn, to the viewer
 * @param pdf        [count]
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_evaluator_eval */
SMX_API smx_status smx_evaluator_pdf(smx_evaluator evaluator, size_t count, const smx_vectors *wi,
                                     const smx_vectors *wo, const smx_scalars_out *pdf);

/** Bound of f cos / pdf over all that smx_evaluator_sample can draw, with masking and in closed form: the largest value
 * of the shared model's curves; of the per-lobe model, the largest F_k / share_k. For orders above 0,
 * docs/packed-material.md has what was measured.
 *
 * @param evaluator  the evaluator
 * @param bound      > 0, or 0 of a black material
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_evaluator_sample_bound(smx_evaluator evaluator, double *bound);

/** Of the widened microsurface, all lobes by their shares (smx_lobe.weight): distribution of normals, 1/sr. Source:
 * Dupuy 2015, chapter 4.
 *
 * @param evaluator  the evaluator
 * @param count      directions
 * @param wh         [count], of any length; 0 where it is not above the surface
 * @param ndf        [count]
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_evaluator_eval */
SMX_API smx_status smx_evaluator_ndf(smx_evaluator evaluator, size_t count, const smx_vectors *wh,
                                     const smx_scalars_out *ndf);

/** Its projected area towards k, over that of the surface. Directions below X's mean plane count as at its horizon.
 *
 * @param evaluator  the evaluator
 * @param count      directions
 * @param k          [count]
 * @param sigma      [count]
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_evaluator_eval */
SMX_API smx_status smx_evaluator_sigma(smx_evaluator evaluator, size_t count, const smx_vectors *k,
                                       const smx_scalars_out *sigma);

/** Its masking, the mean plane's projected area over sigma: the share of facets turned towards k that is seen from
 * there. Source: Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs".
 *
 * @param evaluator  the evaluator
 * @param count      directions
 * @param k          [count]
 * @param g1         [count], 0..1; 0 below the mean plane
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_evaluator_eval */
SMX_API smx_status smx_evaluator_g1(smx_evaluator evaluator, size_t count, const smx_vectors *k,
                                    const smx_scalars_out *g1);

/** The share that is seen from both directions, by the evaluator's masking. Source: the same, equation 99.
 *
 * @param evaluator  the evaluator
 * @param count      pairs of directions
 * @param wi, wo     [count]
 * @param g2         [count], 0..1; 0 where a direction is not above the surface and X's mean plane
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_evaluator_eval */
SMX_API smx_status smx_evaluator_g2(smx_evaluator evaluator, size_t count, const smx_vectors *wi, const smx_vectors *wo,
                                    const smx_scalars_out *g2);

#ifdef __cplusplus
}
#endif
#endif
