/* Mixtures of lobes, fitted, made from arrays, or read from files. (Part of slopemix.h.) */
#ifndef SLOPEMIX_MATERIAL_H
#define SLOPEMIX_MATERIAL_H

#include "density.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SMX_MAX_LOBES 64

typedef struct smx_lobe {
    double weight; /* share of the mixture, > 0; per-lobe: share of the energy, told by the curves. They sum to 1 */
    double alpha;  /* 1e-4..1e4. 0, a mirror, has no density to evaluate: like all outside, INVALID_ARGUMENT */
} smx_lobe;

typedef enum smx_model {
    SMX_MODEL_SHARED = 0,  /* f = F(theta_d) sum_k w_k D_k(wh) G2(wi, wo) / (4 cos_i cos_o): the thesis's */
    SMX_MODEL_PER_LOBE = 1 /* f = sum_k F_k(theta_d) D_k(wh) G2_k(wi, wo) / (4 cos_i cos_o) */
} smx_model;

/* As number of lobes: the smallest whose next lobe lowers the Kullback-Leibler divergence of mixture and slope density
 * by less than 1e-3 nat and the mean relRMSE on displaced spheres by less than 0.005. */
#define SMX_LOBES_AUTO 0u

typedef struct smx_fit_options {
    size_t size;
    smx_model model;
    uint32_t lobes;          /* 1..SMX_MAX_LOBES; the fit may end with fewer where lobes merge or die. Or
                                SMX_LOBES_AUTO */
    double tolerance;        /* EM stops when the mean log likelihood gains less than this, > 0 */
    uint32_t max_iterations; /* of EM, 1..1000000 */
    int refine;              /* nonzero: least-squares refinement (Ceres): of weights and alphas after EM, of alphas
                                and curves of the per-lobe model */
} smx_fit_options;
#define SMX_FIT_OPTIONS_INIT \
    { sizeof(smx_fit_options), SMX_MODEL_PER_LOBE, 8, 1e-6, 20000, 1 }

typedef struct smx_fit_report {
    size_t size;
    uint32_t lobes; /* in the material */
    uint32_t inversion_iterations;
    uint32_t em_iterations;
    uint32_t refine_iterations;
    double log_likelihood_em;   /* mean of log p22 of the mixture under the slope density, per unit mass */
    double log_likelihood;      /* the same after the refinement; per-lobe: of the mixture it began with */
    double residual_em;         /* Hellinger distance of density and mixture, 0..1 */
    double residual;            /* the same after the refinement */
    char refine_message[256];   /* the solver's verdict; "" without refinement */
    uint32_t curve_iterations;  /* the per-lobe model's refinement in BRDF space: its iterations, */
    double brdf_residual_start; /*   relative error in BRDF space before it (root mean square over theta_d), */
    double brdf_residual;       /*   after it, */
    double displaced_share;     /*   share of displaced surfaces in what it minimised, beside the base's 1, */
    char curve_message[256];    /*   and the solver's own report */
    double base_relrmse;        /* estimates of relRMSE on spheres under the experiment's three lights, as means: of */
    double displaced_relrmse;   /*   the base; on displaced ones, alpha 0.1, 0.25 and 0.5; and the latter */
    double displaced_relrmse_shared; /* of the shared model with as many lobes. 0 for a density without a BRDF */
    char choice[512];                /* why this number of lobes or this start, where there was a choice */
    double seconds;                  /* of EM, the curves' start and the refinements */
    double check_seconds; /* of all else: the estimates, the deviations, the albedo, and fits that were not kept */
} smx_fit_report;
#define SMX_FIT_REPORT_INIT \
    { sizeof(smx_fit_report), 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, "", 0, 0.0, 0.0, 0.0, "", 0.0, 0.0, 0.0, "", 0.0, 0.0 }

/* Zero-mean isotropic Beckmann lobes, in ascending alpha, with their Fresnel curves (smx_model). Immutable. */
typedef struct smx_material_s *smx_material;

typedef struct smx_material_info {
    size_t size;
    char name[128];
    char source[512];
    char sha256[65]; /* of the source table or file; "" for a material made from arrays */
    smx_model model;
    uint32_t lobes;
    uint32_t fresnel_knots;
    uint32_t fresnel_sets; /* of three curves: 1 for the shared model, else one per lobe */
} smx_material_info;
#define SMX_MATERIAL_INFO_INIT \
    { sizeof(smx_material_info), "", "", "", SMX_MODEL_SHARED, 0, 0, 0 }

/* Fits `lobes` lobes to a slope density: EM in log space from several starts, then Ceres; the shared model takes over
 * the density's Fresnel curves, the per-lobe model fits its own to the table and refines alphas and curves together,
 * also to the table as it looks on displaced surfaces; where refined it reflects no more than max(1, the table) at
 * the angles of smx_material_get_albedo, to 0.2 %.
 * Statuses: INVALID_ARGUMENT (also the per-lobe model, the default, for a density without a BRDF),
 * NO_SOLUTION, OUT_OF_MEMORY. */
SMX_API smx_status smx_material_fit(smx_density density, const smx_fit_options *options, smx_material *material);

/* What a material is made of, for smx_material_create. */
typedef struct smx_material_desc {
    size_t size;
    const char *name;
    smx_model model;
    const smx_lobe
        *lobes;        /* [lobe_count]; shared: weights are normalised to sum to 1; per-lobe: weights are not read */
    size_t lobe_count; /* 1..SMX_MAX_LOBES */
    const double *theta_d; /* [knots] ascending from 0 to pi/2; NULL: equidistant */
    size_t knots;          /* 2..4096 */
    const double
        *fresnel; /* [sets][3][knots], values >= 0, linear between the knots; sets: 1, or per-lobe lobe_count */
} smx_material_desc;
#define SMX_MATERIAL_DESC_INIT \
    { sizeof(smx_material_desc), "material", SMX_MODEL_SHARED, NULL, 0, NULL, 0, NULL }

/* From arrays, which are copied. Statuses: INVALID_ARGUMENT, OUT_OF_MEMORY. */
SMX_API smx_status smx_material_create(const smx_material_desc *desc, smx_material *material);
SMX_API smx_status smx_material_retain(smx_material material);
SMX_API void smx_material_release(smx_material material);
SMX_API smx_status smx_material_get_info(smx_material material, smx_material_info *info);

/* How the fit went; a material made from arrays has a report of zeros but for the number of lobes. Statuses:
 * INVALID_ARGUMENT. */
SMX_API smx_status smx_material_get_report(smx_material material, smx_fit_report *report);

/* Standard deviations of a refined per-lobe fit's parameters, from the covariance of its least-squares problem scaled
 * by the residual variance: alpha [lobes], and curves [lobes][3][SMX_CURVE_COEFFICIENTS] of the curves' B-spline
 * coefficients (docs/material-format.md says where in theta_d each sits). SMX_HELD marks a parameter at a bound, which
 * was not free. `count` must be info.lobes; either array may be NULL.
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (another material has none). */
#define SMX_CURVE_COEFFICIENTS 13
#define SMX_HELD (-1.0)
SMX_API smx_status smx_material_get_deviations(smx_material material, double *alpha, double *curves, size_t count);

/* Directional albedo of a fitted material and of its table: theta_o [SMX_ALBEDO_ANGLES] in radians; table, fit
 * [SMX_ALBEDO_ANGLES][3]. A refined per-lobe fit has at most max(1, the table's). Any array may be NULL.
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (a material that was not fitted to a BRDF has none). */
#define SMX_ALBEDO_ANGLES 8
SMX_API smx_status smx_material_get_albedo(smx_material material, double *theta_o, double *table, double *fit);

/* Copies the lobes; `count` must be info.lobes. Statuses: INVALID_ARGUMENT. */
SMX_API smx_status smx_material_get_lobes(smx_material material, smx_lobe *lobes, size_t count);

/* Copies the curves: theta_d [knots], fresnel [sets][3][knots]; `count` must be sets * 3 * knots. Either may be NULL.
 * Statuses: INVALID_ARGUMENT. */
SMX_API smx_status smx_material_get_fresnel(smx_material material, double *theta_d, double *fresnel, size_t count);

/* Material files are JSON, schema in docs/material-format.md. Saving is atomic. Loading refuses an unknown version, a
 * missing or unknown key and a value of the wrong type or range, and names its path in the message.
 * Statuses: INVALID_ARGUMENT, CANNOT_READ, CANNOT_WRITE, BAD_FORMAT. */
SMX_API smx_status smx_material_load(const char *path, smx_material *material);
SMX_API smx_status smx_material_save(smx_material material, const char *path);

/* A density and a material as tables: f in 1/sr, not displaced, at the nodes of a MERL table with 180 values of phi_d;
 * in double on the host, with height-correlated masking; cells below the horizon are invalid. Tables like any other,
 * with source "memory" and the name of what they are from: a reference of such a table, against the measured one's, has
 * the error of the inversion or of the fit and none of the widening.
 *   density   f = F(theta_d) D(wh) G2(wi, wo) / (4 cos_i cos_o), before any lobe is fitted: D on the inversion's nodes,
 *             G2 from the projected area of that D, integrated numerically; F is 1 for a density without a BRDF
 *   material  the formula of its model
 * Statuses: INVALID_ARGUMENT, BAD_FORMAT (an f above 1e30, more than a table takes), OUT_OF_MEMORY. */
SMX_API smx_status smx_density_tabulate(smx_density density, smx_brdf *brdf);
SMX_API smx_status smx_material_tabulate(smx_material material, smx_brdf *brdf);

/** The material as the device header reads it (smx_device_header): a flat buffer of floats, its layout versioned and in
 * docs/packed-material.md. It holds no pointers, and may be copied, stored and sent.
 *
 * @param material  the material
 * @param words     [count], written; or NULL, to ask for the size alone
 * @param count     with `words`, its number of floats, which must be the material's; NULL is an error
 *                  On return the material's number of floats.
 * @threads   any; the material is not changed
 * @statuses  INVALID_ARGUMENT (also a *count that is not the material's) */
SMX_API smx_status smx_material_pack(smx_material material, float *words, size_t *count);

/** The device header, cl/slopemix.clh with all that it includes, as one text: a kernel's source may begin with it where
 * the installed files are not at hand. Include guards are in it: once is enough.
 *
 * @return    the text, the library's own and valid for ever; never NULL but where memory is short
 * @threads   any */
SMX_API const char *smx_device_header(void);

#ifdef __cplusplus
}
#endif
#endif
