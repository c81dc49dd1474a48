/* Errors in BRDF space, and models to compare with. (Part of slopemix.h.) */
#ifndef SLOPEMIX_BRDF_ERRORS_H
#define SLOPEMIX_BRDF_ERRORS_H

#include "material.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How far a model f is from a table r: roots of weighted means of squares over the table's valid cells, both orders of
 * each pair of directions, and the three channels; docs/metrics.md has weights and sources.
 *   l2         (f - r) cos_i, 1/sr
 *   log        ln(1 + f cos_i) - ln(1 + r cos_i)
 *   cube_root  (f cos_i)^(1/3) - (r cos_i)^(1/3)
 * Those with _80 are the same without the pairs of which a direction is more than 80 degrees from the normal. */
typedef struct smx_brdf_errors {
    size_t size;
    double l2, log, cube_root;
    double l2_80, log_80, cube_root_80;
} smx_brdf_errors;
#define SMX_BRDF_ERRORS_INIT \
    { sizeof(smx_brdf_errors), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }

/* Errors of `brdf` against `reference`, at the cells that are valid in both.
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (no cell to compare within 80 degrees). */
SMX_API smx_status smx_brdf_compare(smx_brdf brdf, smx_brdf reference, smx_brdf_errors *errors);

/* Errors of a material, not displaced, with height-correlated masking, at the reference's valid cells; in double on the
 * host. Same statuses. */
SMX_API smx_status smx_material_brdf_errors(smx_material material, smx_brdf reference, smx_brdf_errors *errors);

/* Models of a few parameters, to compare a mixture with:
 * f = (f0 + (f90 - f0)(1 - cos theta_d)^5) D G2 / (4 cos_i cos_o) + kd / pi, with height-correlated Smith masking. */
typedef enum smx_baseline {
    SMX_BASELINE_BECKMANN = 0,   /* one Beckmann lobe, kd = 0 */
    SMX_BASELINE_GGX = 1,        /* one GGX lobe, kd = 0 */
    SMX_BASELINE_GGX_LAMBERT = 2 /* one GGX lobe and a Lambertian body */
} smx_baseline;

typedef struct smx_baseline_report {
    size_t size;
    double alpha;    /* 1e-4..1e4 */
    double f0[3];    /* per channel, >= 0 */
    double f90[3];   /* per channel, >= 0 */
    double kd[3];    /* per channel, >= 0 */
    double residual; /* log error of the cells that were fitted, relative to that of a black model */
    uint32_t iterations;
    char message[256]; /* the solver's verdict */
    double seconds;    /* of the fit, the errors apart */
    smx_brdf_errors errors;
} smx_baseline_report;
#define SMX_BASELINE_REPORT_INIT                                                                              \
    {                                                                                                         \
        sizeof(smx_baseline_report), 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0, "", 0.0, \
            SMX_BRDF_ERRORS_INIT                                                                              \
    }

/* Fits a baseline to a table by the log error over a share of its cells, from several starts (docs/metrics.md).
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (a table of zeros, no start that converges), OUT_OF_MEMORY. */
SMX_API smx_status smx_baseline_fit(smx_brdf brdf, smx_baseline kind, smx_baseline_report *report);

#ifdef __cplusplus
}
#endif
#endif
