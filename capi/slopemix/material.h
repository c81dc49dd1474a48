/** @file
 * Mixtures of lobes, fitted, made from arrays, or read from files. (Part of slopemix.h.) */
#ifndef SLOPEMIX_MATERIAL_H
#define SLOPEMIX_MATERIAL_H

#include "density.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Most lobes that a material has. */
#define SMX_MAX_LOBES 64

/** A lobe of a material. */
typedef struct smx_lobe {
    double weight; /**< share of the mixture, > 0; per-lobe: share of the energy, told by the curves. They sum to 1 */
    double alpha;  /**< 1e-4..1e4. 0, a mirror, has no density to evaluate: like all outside, INVALID_ARGUMENT */
} smx_lobe;

/** How lobes make a BRDF. */
typedef enum smx_model {
    SMX_MODEL_SHARED = 0,  /**< f = F(theta_d) sum_k w_k D_k(wh) G2(wi, wo) / (4 cos_i cos_o): the thesis's */
    SMX_MODEL_PER_LOBE = 1 /**< f = sum_k F_k(theta_d) D_k(wh) G2_k(wi, wo) / (4 cos_i cos_o) */
} smx_model;

/** As number of lobes: the smallest whose next lobe lowers the Kullback-Leibler divergence of mixture and slope density
 * by less than 1e-3 nat and the mean relRMSE on displaced spheres by less than 0.005. */
#define SMX_LOBES_AUTO 0u

/** How a material is fitted. */
typedef struct smx_fit_options {
    size_t size;             /**< sizeof(smx_fit_options) */
    smx_model model;         /**< shared, or per-lobe */
    uint32_t lobes;          /**< 1..SMX_MAX_LOBES; the fit may end with fewer where lobes merge or die. Or
                                SMX_LOBES_AUTO */
    double tolerance;        /**< EM stops when the mean log likelihood gains less than this, > 0 */
    uint32_t max_iterations; /**< of EM, 1..1000000 */
    int refine;              /**< nonzero: least-squares refinement (Ceres): of weights and alphas after EM, of alphas
                                and curves of the per-lobe model */
} smx_fit_options;
/** Defaults of smx_fit_options. */
#define SMX_FIT_OPTIONS_INIT \
    { sizeof(smx_fit_options), SMX_MODEL_PER_LOBE, 8, 1e-6, 20000, 1 }

/** How a fit went. */
typedef struct smx_fit_report {
    size_t size;                   /**< sizeof(smx_fit_report) */
    uint32_t lobes;                /**< in the material */
    uint32_t inversion_iterations; /**< of the power iteration */
    uint32_t em_iterations;        /**< of EM */
    uint32_t refine_iterations;    /**< of the refinement of weights and alphas */
    double log_likelihood_em;      /**< mean of log p22 of the mixture under the slope density, per unit mass */
    double log_likelihood;         /**< the same after the refinement; per-lobe: of the mixture it began with */
    double residual_em;            /**< Hellinger distance of density and mixture, 0..1 */
    double residual;               /**< the same after the refinement */
    char refine_message[256];      /**< the solver's verdict; "" without refinement */
    uint32_t curve_iterations;     /**< of the per-lobe model's refinement in BRDF space */
    double brdf_residual_start;    /**< relative error in BRDF space before it, root mean square over theta_d */
    double brdf_residual;          /**< the same after it */
    double displaced_share;        /**< share of displaced surfaces in what it minimised, beside the base's 1 */
    char curve_message[256];       /**< its solver's own report */
    double base_relrmse;           /**< estimate of relRMSE on spheres under the experiment's three lights, as mean: of
                                        the base */
    double displaced_relrmse;      /**< the same on displaced ones, alpha 0.1, 0.25 and 0.5 */
    double displaced_relrmse_shared; /**< the same of the shared model with as many lobes. 0 for a density without a
                                          BRDF, like the two above */
    char choice[512];                /**< why this number of lobes or this start, where there was a choice */
    double seconds;                  /**< of EM, the curves' start and the refinements */
    double check_seconds; /**< of all else: the estimates, the deviations, the albedo, and fits that were not kept */
} smx_fit_report;
/** Initialiser of smx_fit_report. */
#define SMX_FIT_REPORT_INIT \
    { sizeof(smx_fit_report), 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, "", 0, 0.0, 0.0, 0.0, "", 0.0, 0.0, 0.0, "", 0.0, 0.0 }

/** Zero-mean isotropic Beckmann lobes, in ascending alpha, with their Fresnel curves (smx_model). Immutable. */
typedef struct smx_material_s *smx_material;

/** Facts about a material. */
typedef struct smx_material_info {
    size_t size;            /**< sizeof(smx_material_info) */
    char name[128];         /**< of the source, or as given */
    char source[512];       /**< path of the table or density, "builtin:NAME", "analytic:...", or "memory" */
    char sha256[65];        /**< of the source table or file; "" for a material made from arrays */
    smx_model model;        /**< shared, or per-lobe */
    uint32_t lobes;         /**< their number */
    uint32_t fresnel_knots; /**< of each curve */
    uint32_t fresnel_sets;  /**< of three curves: 1 for the shared model, else one per lobe */
} smx_material_info;
/** Initialiser of smx_material_info. */
#define SMX_MATERIAL_INFO_INIT \
    { sizeof(smx_material_info), "", "", "", SMX_MODEL_SHARED, 0, 0, 0 }

/** Fits lobes to a slope density: EM in log space from several starts, then Ceres; the shared model takes over the
 * density's Fresnel curves, the per-lobe model fits its own to the table and refines alphas and curves together, also
 * to the table as it looks on displaced surfaces; where refined it reflects no more than max(1, the table) at the
 * angles of smx_material_get_albedo, to 0.2 %. Source: docs/fit.md.
 *
 * @param density   what is fitted
 * @param options   how; NULL: the defaults
 * @param material  the new handle
 * @ownership  the caller owns one reference of `*material`
 * @threads    any
 * @statuses   INVALID_ARGUMENT (also the per-lobe model, the default, for a density without a BRDF), NO_SOLUTION,
 *             OUT_OF_MEMORY */
SMX_API smx_status smx_material_fit(smx_density density, const smx_fit_options *options, smx_material *material);

/** What a material is made of, for smx_material_create. */
typedef struct smx_material_desc {
    size_t size;      /**< sizeof(smx_material_desc) */
    const char *name; /**< shown in reports */
    smx_model model;  /**< shared, or per-lobe */
    const smx_lobe
        *lobes;        /**< [lobe_count]; shared: weights are normalised to sum to 1; per-lobe: weights are not read */
    size_t lobe_count; /**< 1..SMX_MAX_LOBES */
    const double *theta_d; /**< [knots] ascending from 0 to pi/2; NULL: equidistant */
    size_t knots;          /**< 2..4096 */
    const double
        *fresnel; /**< [sets][3][knots], values >= 0, linear between the knots; sets: 1, or per-lobe lobe_count */
} smx_material_desc;
/** Initialiser of smx_material_desc; lobes and curves must be set. */
#define SMX_MATERIAL_DESC_INIT \
    { sizeof(smx_material_desc), "material", SMX_MODEL_SHARED, NULL, 0, NULL, 0, NULL }

/** Makes a material from arrays.
 *
 * @param desc      what it is made of
 * @param material  the new handle
 * @ownership  the caller owns one reference of `*material`; the arrays are copied
 * @threads    any
 * @statuses   INVALID_ARGUMENT, OUT_OF_MEMORY */
SMX_API smx_status smx_material_create(const smx_material_desc *desc, smx_material *material);

/** Adds a reference.
 *
 * @param material  the handle
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_material_retain(smx_material material);

/** Drops a reference.
 *
 * @param material  the handle, or NULL
 * @threads  any */
SMX_API void smx_material_release(smx_material material);

/** Facts about a material.
 *
 * @param material  the material
 * @param info      written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_material_get_info(smx_material material, smx_material_info *info);

/** How the fit went; a material made from arrays has a report of zeros but for the number of lobes.
 *
 * @param material  the material
 * @param report    written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_material_get_report(smx_material material, smx_fit_report *report);

/** B-spline coefficients of a curve (smx_material_get_deviations). */
#define SMX_CURVE_COEFFICIENTS 13
/** In place of the standard deviation of a parameter at a bound, which was not free. */
#define SMX_HELD (-1.0)

/** Standard deviations of a refined per-lobe fit's parameters, from the covariance of its least-squares problem scaled
 * by the residual variance. Either array may be NULL.
 *
 * @param material  the material
 * @param alpha     [count], or SMX_HELD
 * @param curves    [count][3][SMX_CURVE_COEFFICIENTS] of the curves' B-spline coefficients, or SMX_HELD;
 *                  docs/material-format.md says where in theta_d each sits
 * @param count     smx_material_info.lobes
 * @threads   any
 * @statuses  INVALID_ARGUMENT, NO_SOLUTION (another material has none) */
SMX_API smx_status smx_material_get_deviations(smx_material material, double *alpha, double *curves, size_t count);

/** Angles at which smx_material_get_albedo has values. */
#define SMX_ALBEDO_ANGLES 8

/** Directional albedo of a fitted material and of its table. A refined per-lobe fit has at most max(1, the table's).
 * Any array may be NULL.
 *
 * @param material  the material
 * @param theta_o   [SMX_ALBEDO_ANGLES] of wo, radians
 * @param table     [SMX_ALBEDO_ANGLES][3] of the table
 * @param fit       [SMX_ALBEDO_ANGLES][3] of the material
 * @threads   any
 * @statuses  INVALID_ARGUMENT, NO_SOLUTION (a material that was not fitted to a BRDF has none) */
SMX_API smx_status smx_material_get_albedo(smx_material material, double *theta_o, double *table, double *fit);

/** Copies the lobes.
 *
 * @param material  the material
 * @param lobes     [count] in ascending alpha
 * @param count     smx_material_info.lobes
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_material_get_lobes(smx_material material, smx_lobe *lobes, size_t count);

/** Copies the curves. Either array may be NULL.
 *
 * @param material  the material
 * @param theta_d   [knots] radians
 * @param fresnel   [sets][3][knots]
 * @param count     sets * 3 * knots, of smx_material_info.fresnel_sets and fresnel_knots
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_material_get_fresnel(smx_material material, double *theta_d, double *fresnel, size_t count);

/** Reads a material file: JSON, schema in docs/material-format.md. Refuses an unknown version, a missing or unknown key
 * and a value of the wrong type or range, and names its path in the message.
 *
 * @param path      of the file
 * @param material  the new handle
 * @ownership  the caller owns one reference of `*material`
 * @threads    any
 * @statuses   INVALID_ARGUMENT, CANNOT_READ, BAD_FORMAT, OUT_OF_MEMORY */
SMX_API smx_status smx_material_load(const char *path, smx_material *material);

/** Writes a material file. Atomic.
 *
 * @param material  the material
 * @param path      of the file
 * @threads   any
 * @statuses  INVALID_ARGUMENT, CANNOT_WRITE, OUT_OF_MEMORY */
SMX_API smx_status smx_material_save(smx_material material, const char *path);

/** A density as a table, before any lobe is fitted: f in 1/sr, not displaced, at the nodes of a MERL table with 180
 * values of phi_d, in double on the host; cells below the horizon are invalid.
 * f = F(theta_d) D(wh) G2(wi, wo) / (4 cos_i cos_o), height-correlated: D on the inversion's nodes, G2 from the
 * projected area of that D, integrated numerically; F is 1 for a density without a BRDF. A table like any other, with
 * source "memory" and the name of what it is from: a reference of it, against the measured one's, has the error of the
 * inversion and none of the widening.
 *
 * @param density  the density
 * @param brdf     the new handle
 * @ownership  the caller owns one reference of `*brdf`
 * @threads    any
 * @statuses   INVALID_ARGUMENT, BAD_FORMAT (an f above 1e30, more than a table takes), OUT_OF_MEMORY */
SMX_API smx_status smx_density_tabulate(smx_density density, smx_brdf *brdf);

/** A material as a table, like smx_density_tabulate, by the formula of its model: a reference of it has the error of
 * the inversion and the fit, and none of the widening.
 *
 * @param material  the material
 * @param brdf      the new handle
 * @ownership  the caller owns one reference of `*brdf`
 * @threads    any
 * @statuses   those of smx_density_tabulate */
SMX_API smx_status smx_material_tabulate(smx_material material, smx_brdf *brdf);

/** The material as the device header reads it (smx_device_header): a flat buffer of floats, its layout versioned and in
 * docs/packed-material.md. It holds no pointers, and may be copied, stored and sent.
 *
 * @param material  the material, not changed
 * @param words     [count], written; or NULL, to ask for the size alone
 * @param count     with `words`, its number of floats, which must be the material's; on return the material's number
 *                  of floats
 * @threads   any
 * @statuses  INVALID_ARGUMENT (also a *count that is not the material's) */
SMX_API smx_status smx_material_pack(smx_material material, float *words, size_t *count);

/** The device header, cl/slopemix.clh with all that it includes, as one text: a kernel's source may begin with it where
 * the installed files are not at hand. Include guards are in it: once is enough.
 *
 * @return     the text; never NULL but where memory is short
 * @ownership  the library's, valid for ever
 * @threads    any */
SMX_API const char *smx_device_header(void);

#ifdef __cplusplus
}
#endif
#endif
