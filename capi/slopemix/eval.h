/** @file
 * Values of materials and tables for pairs of directions. (Part of slopemix.h.) */
#ifndef SLOPEMIX_EVAL_H
#define SLOPEMIX_EVAL_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/** f cos of the material widened by X. 0 where either direction is not above the surface. Not normalised: directions
 * must be unit vectors. Source: Dupuy 2015, chapter 5, or docs/widening.md for orders above 0.
 *
 * @param context       where it is evaluated
 * @param material      what is evaluated
 * @param displacement  X, the roughness that widens every lobe
 * @param masking       height-correlated, or separable
 * @param options       grade, effects and widening_order count; SMX_WIDENING_AUTO needs an image. NULL: the defaults
 * @param count         pairs of directions
 * @param wi, wo        [count][3], packed; to the light, to the viewer
 * @param fcos          [count][3], packed; linear RGB, 1/sr
 * @threads   any; calls on one context run one after another
 * @statuses  INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY; after the last three `fcos` may be half
 *            written */
SMX_API smx_status smx_material_eval(smx_context context, smx_material material, const smx_displacement *displacement,
                                     smx_masking masking, const smx_render_options *options, size_t count,
                                     const float *wi, const float *wo, float *fcos);

/** The reference of smx_material_eval: f cos of the measured table integrated over X's facets. 0 where either direction
 * is not above the surface; unit vectors, as there. All pairs share their facets: give many at once. Arrays are planes:
 * all x (or red), all y, all z. Source: Dupuy 2015, chapter 5.
 *
 * @param context       where it is integrated
 * @param brdf          the table
 * @param displacement  X
 * @param masking       of X: height-correlated, or separable
 * @param options       as of smx_render_reference; errors and whole_table have no effect, exr_path must be NULL.
 *                      NULL: the defaults
 * @param count         pairs of directions
 * @param wi, wo        [3][count] to the light, to the viewer
 * @param fcos          [3][count], linear RGB, 1/sr
 * @param errors        [3][count] standard errors, on the options' terms for an image's; or NULL
 * @param report        its standard_error, and a target_error, are over all pairs; its size field must be set; or NULL
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_render_reference */
SMX_API smx_status smx_brdf_integrate(smx_context context, smx_brdf brdf, const smx_displacement *displacement,
                                      smx_masking masking, const smx_render_options *options, size_t count,
                                      const float *wi, const float *wo, float *fcos, float *errors,
                                      smx_render_report *report);

/** f of the measured table, NOT times a cosine. Half and difference angles of the pair, phi_d modulo pi, values past
 * the last theta_h or theta_d are the last node's (smx_lookup; a table over the full azimuth is the mean of its
 * halves). 0 where either direction is not above the surface. Not normalised: directions must be unit vectors. The
 * table goes to the device at every call: give many pairs at once.
 *
 * @param context  where it is evaluated
 * @param brdf     the table
 * @param lookup   how it is read between its nodes
 * @param count    pairs of directions
 * @param wi, wo   [count][3], packed; to the light, to the viewer
 * @param f        [count][3], packed; linear RGB, 1/sr
 * @threads   any; calls on one context run one after another
 * @statuses  INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY */
SMX_API smx_status smx_brdf_eval(smx_context context, smx_brdf brdf, smx_lookup lookup, size_t count, const float *wi,
                                 const float *wo, float *f);

#ifdef __cplusplus
}
#endif
#endif
