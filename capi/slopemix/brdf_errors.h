/** @file
 * Errors in BRDF space, and models to compare with. (Part of slopemix.h.) */
#ifndef SLOPEMIX_BRDF_ERRORS_H
#define SLOPEMIX_BRDF_ERRORS_H

#include "material.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How far a model f is from a table r: roots of weighted means of squares over the table's valid cells, both orders of
 * each pair of directions, and the three channels; docs/metrics.md has weights and sources. */
typedef struct smx_brdf_errors {
    size_t size;         /**< sizeof(smx_brdf_errors) */
    double l2;           /**< (f - r) cos_i, 1/sr */
    double log;          /**< ln(1 + f cos_i) - ln(1 + r cos_i) */
    double cube_root;    /**< (f cos_i)^(1/3) - (r cos_i)^(1/3) */
    double l2_80;        /**< without the pairs of which a direction is more than 80 degrees from the normal; */
    double log_80;       /**< likewise; */
    double cube_root_80; /**< likewise */
} smx_brdf_errors;
/** Initialiser of smx_brdf_errors. */
#define SMX_BRDF_ERRORS_INIT \
    { sizeof(smx_brdf_errors), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }

/** Errors of a table against another, at the cells that are valid in both.
 *
 * @param brdf       the table
 * @param reference  what it is compared with
 * @param errors     written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT, NO_SOLUTION (no cell to compare within 80 degrees) */
SMX_API smx_status smx_brdf_compare(smx_brdf brdf, smx_brdf reference, smx_brdf_errors *errors);

/** Errors of a material, not displaced, with height-correlated masking, at the reference's valid cells; in double on
 * the host.
 *
 * @param material   the material
 * @param reference  what it is compared with
 * @param errors     written; its size field must be set
 * @threads   any
 * @statuses  those of smx_brdf_compare */
SMX_API smx_status smx_material_brdf_errors(smx_material material, smx_brdf reference, smx_brdf_errors *errors);

/** Models of a few parameters, to compare a mixture with:
 * f = (f0 + (f90 - f0)(1 - cos theta_d)^5) D G2 / (4 cos_i cos_o) + kd / pi, with height-correlated Smith masking. */
typedef enum smx_baseline {
    SMX_BASELINE_BECKMANN = 0,   /**< one Beckmann lobe, kd = 0 */
    SMX_BASELINE_GGX = 1,        /**< one GGX lobe, kd = 0 */
    SMX_BASELINE_GGX_LAMBERT = 2 /**< one GGX lobe and a Lambertian body */
} smx_baseline;

/** A fitted baseline. */
typedef struct smx_baseline_report {
    size_t size;            /**< sizeof(smx_baseline_report) */
    double alpha;           /**< 1e-4..1e4 */
    double f0[3];           /**< per channel, >= 0 */
    double f90[3];          /**< per channel, >= 0 */
    double kd[3];           /**< per channel, >= 0 */
    double residual;        /**< log error of the cells that were fitted, relative to that of a black model */
    uint32_t iterations;    /**< of the solver */
    char message[256];      /**< the solver's verdict */
    double seconds;         /**< of the fit, the errors apart */
    smx_brdf_errors errors; /**< against the table */
} smx_baseline_report;
/** Initialiser of smx_baseline_report. */
#define SMX_BASELINE_REPORT_INIT                                                                              \
    {                                                                                                         \
        sizeof(smx_baseline_report), 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0, "", 0.0, \
            SMX_BRDF_ERRORS_INIT                                                                              \
    }

/** Fits a baseline to a table by the log error over a share of its cells, from several starts. Source: docs/metrics.md.
 *
 * @param brdf    the table
 * @param kind    which baseline
 * @param report  written; its size field, and that of `errors` in it, must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT, NO_SOLUTION (a table of zeros, no start that converges), OUT_OF_MEMORY */
SMX_API smx_status smx_baseline_fit(smx_brdf brdf, smx_baseline kind, smx_baseline_report *report);

#ifdef __cplusplus
}
#endif
#endif
