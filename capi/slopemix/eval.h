/* Values of materials and tables for pairs of directions. (Part of slopemix.h.) */
#ifndef SLOPEMIX_EVAL_H
#define SLOPEMIX_EVAL_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* f cos of the material widened by X, for `count` pairs of directions. wi, wo, fcos: [count][3], packed.
 * 0 where either direction is not above the surface. Not normalised: directions must be unit vectors. Of the options,
 * which may be NULL, grade, effects and widening_order count; SMX_WIDENING_AUTO needs an image.
 * Statuses: INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY. */
SMX_API smx_status smx_material_eval(smx_context context, smx_material material, const smx_displacement *displacement,
                                     smx_masking masking, const smx_render_options *options, size_t count,
                                     const float *wi, const float *wo, float *fcos);

/* The reference of smx_material_eval: f cos of the measured table integrated over X's facets, for `count` pairs of
 * directions. wi, wo, fcos, errors are planes, [3][count]: all x (or red), all y, all z. `errors` takes the standard
 * errors, on the options' terms for an image's, or is NULL; options->errors and ->whole_table have no effect,
 * ->exr_path must be NULL. The report's standard_error and a target_error are over all pairs. 0 where either direction
 * is not above the surface; unit vectors, as there. All pairs share their facets: give many at once.
 * Statuses: those of smx_render_reference. */
SMX_API smx_status smx_brdf_integrate(smx_context context, smx_brdf brdf, const smx_displacement *displacement,
                                      smx_masking masking, const smx_render_options *options, size_t count,
                                      const float *wi, const float *wo, float *fcos, float *errors,
                                      smx_render_report *report);

/* f of the measured table in 1/sr, NOT times a cosine, for `count` pairs of directions. wi, wo, f: [count][3], packed.
 * Half and difference angles of the pair, phi_d modulo pi, values past the last theta_h or theta_d are the last node's
 * (smx_lookup; a table over the full azimuth is the mean of its halves). 0 where either direction is not above the
 * surface. Not normalised: directions must be unit vectors. The table goes to the device at every call: give many pairs
 * at once. Statuses: INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY. */
SMX_API smx_status smx_brdf_eval(smx_context context, smx_brdf brdf, smx_lookup lookup, size_t count, const float *wi,
                                 const float *wo, float *f);

#ifdef __cplusplus
}
#endif
#endif
