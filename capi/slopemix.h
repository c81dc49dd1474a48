/* slopemix: how a measured material looks on a surface that is rough below the pixel.
 *
 * Conventions
 *   Directions    unit vectors that point away from the surface; wi to the light, wo to the viewer; frame x, y, z
 *                 with z the macro-surface normal, x along elevation (e_theta), y along azimuth (e_phi).
 *   Slopes        of a facet with normal m: (-m.x / m.z, -m.y / m.z).
 *   Roughness     alpha = sqrt(2) times the standard deviation of the slope. Variances add; alphas do not.
 *   Radiometry    linear RGB; f in 1/sr; "fcos" means f times the cosine of wi; a pixel is the radiance towards the
 *                 viewer under a light of unit perpendicular irradiance (a white Lambertian facing it shows 1/pi).
 *   Angles        radians.
 *   Images        row 0 at the top, left to right, RGBA float32; alpha is 1 on the surface and 0 off it.
 *
 * Handles are reference counted: smx_*_create gives one reference, smx_*_retain adds one, smx_*_release drops one
 * (NULL is legal). A child keeps its parents alive, so any order of release is legal.
 *
 * Errors. A function that can fail returns smx_status. When it fails, its outputs are untouched and smx_last_error()
 * says, for the calling thread, what was wrong, with the value and the legal range. The library never prints or exits;
 * what an OpenCL implementation does is its own (docs/robustness.md).
 *
 * Threads. Any function may be called from any thread. Immutable handles (brdf, density, material) may be shared
 * freely; calls that use one context run one after another; an image may be read by many threads or changed by one.
 *
 * Options are structs that start with their own size: initialise with the macro of the same name in capitals
 * (smx_scene s = SMX_SCENE_INIT;), change fields, pass the address. NULL in place of options means the defaults.
 * The size must be that of this version's struct; a later version that adds fields takes this one's too.
 */
#ifndef SLOPEMIX_H
#define SLOPEMIX_H

#include <stddef.h>
#include <stdint.h>

#include "slopemix_version.h"

#if defined(_WIN32)
#define SMX_API __declspec(dllimport)
#elif defined(SMX_BUILDING_LIBRARY)
#define SMX_API __attribute__((visibility("default")))
#else
#define SMX_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------------------------------------- status and version */

typedef enum smx_status {
    SMX_OK = 0,
    SMX_INVALID_ARGUMENT = 1, /* a null pointer, a wrong size field, a value out of its range */
    SMX_CANNOT_READ = 2,      /* a file is missing or unreadable */
    SMX_CANNOT_WRITE = 3,     /* an output cannot be made; what was there before is still there */
    SMX_BAD_FORMAT = 4,       /* a file's content is not what its format demands */
    SMX_NO_DEVICE = 5,        /* no OpenCL device, or none that matches */
    SMX_KERNEL_BUILD = 6,     /* the device's compiler refused a kernel; its log is in the message */
    SMX_DEVICE_ERROR = 7,     /* an OpenCL call failed */
    SMX_OUT_OF_MEMORY = 8,    /* host or device memory */
    SMX_NO_SOLUTION = 9,      /* the data have no answer: a table of zeros, a fit that cannot start */
    SMX_CANCELLED = 10,       /* a progress callback asked to stop */
    SMX_INTERNAL = 11         /* a fault of the library itself */
} smx_status;

/* Name ("SMX_BAD_FORMAT") and sentence of a status; "unknown status" for a value that is none. Static strings. */
SMX_API const char *smx_status_name(smx_status status);
SMX_API const char *smx_status_text(smx_status status);

/* What the last failing call of this thread had to say; "" if none failed. Valid until the thread's next call. */
SMX_API const char *smx_last_error(void);

/* Version of the library in use, "MAJOR.MINOR.PATCH"; SMX_VERSION_STRING is the header's. */
SMX_API const char *smx_version(void);

/* Called now and then with the share done, 0..1, from the thread that made the call; nonzero stops the work, and the
 * call returns SMX_CANCELLED. It starts again from 0 where a target_error needs more samples. The callback may not
 * render or evaluate on the same context: such a call returns SMX_INVALID_ARGUMENT. */
typedef int (*smx_progress_fn)(void *user, double share);

/* ------------------------------------------------------------------------------------------------ context and devices */

typedef struct smx_device_info {
    size_t size;
    uint32_t index; /* position over all platforms; what smx_context_options.device takes as a number */
    char name[128];
    char vendor[128];
    char version[128]; /* OpenCL version of the device */
    char driver[128];
    char platform[128];
    char platform_version[128];
    uint32_t compute_units;
    uint64_t global_memory; /* bytes */
    uint32_t vector_width;  /* evaluations per work-item that slopemix uses on it: 1, 4, 8 or 16 */
    double build_seconds;   /* of a context: what compiling kernels has taken so far, on the device that took longest */
    uint32_t devices;       /* of a context: how many work together; compute_units is their sum, all else the first's */
} smx_device_info;
#define SMX_DEVICE_INFO_INIT \
    { sizeof(smx_device_info), 0, "", "", "", "", "", "", 0, 0, 0, 0.0, 0 }

/* Number of OpenCL devices over all platforms; 0 is not an error.
 * Statuses: INVALID_ARGUMENT (count is null). */
SMX_API smx_status smx_device_count(uint32_t *count);

/* Facts about device `index`, 0 <= index < count.
 * Statuses: INVALID_ARGUMENT, NO_DEVICE (no such index). */
SMX_API smx_status smx_device_get_info(uint32_t index, smx_device_info *info);

typedef struct smx_context_options {
    size_t size;
    const char *device;    /* NULL: first CPU, else first device; digits: an index; else part of a name, any case;
                              several, separated by commas, work together */
    void *cl_context;      /* the caller's cl_context and cl_command_queue, both or neither; retained; the queue */
    void *cl_queue;        /*   must be in order; `device` must be NULL */
    uint32_t vector_width; /* 0: from the first device; else 1, 4, 8 or 16 evaluations per work-item */
    uint32_t sub_devices;  /* 0 or 1: devices are whole; else each is cut into as many like sub-devices, at most its
                              compute units; not with cl_context */
} smx_context_options;
#define SMX_CONTEXT_OPTIONS_INIT \
    { sizeof(smx_context_options), NULL, NULL, NULL, 0, 0 }

/* Devices, their queues and the kernels built for them. Kernels are built on first use and kept. Rendering and
 * smx_brdf_integrate take tiles from one queue on all devices, with the same bits on any number of like devices at one
 * vector_width; smx_material_eval and smx_brdf_eval run on the first.
 * Statuses: INVALID_ARGUMENT, NO_DEVICE, DEVICE_ERROR. */
typedef struct smx_context_s *smx_context;
SMX_API smx_status smx_context_create(const smx_context_options *options, smx_context *context);
SMX_API smx_status smx_context_retain(smx_context context);
SMX_API void smx_context_release(smx_context context);
SMX_API smx_status smx_context_get_info(smx_context context, smx_device_info *info);

/* ---------------------------------------------------------------------------------------------------- measured BRDF */

typedef enum smx_lookup {
    SMX_LOOKUP_LINEAR = 0, /* values at the nodes (k/90)^2 pi/2, k pi/180, k pi/180; linear in (sqrt theta_h, ...) */
    SMX_LOOKUP_NEAREST = 1 /* the cell that holds the angles, as in the lookup code that came with MERL */
} smx_lookup;

/* An isotropic measured BRDF on the MERL grid (Matusik et al. 2003): [rgb][theta_h][theta_d][phi_d]. Immutable. */
typedef struct smx_brdf_s *smx_brdf;

typedef struct smx_brdf_info {
    size_t size;
    char name[128];   /* file name without its ending, or what follows "builtin:" or "analytic:", with _ for / */
    char source[512]; /* path, "builtin:NAME", "analytic:...", or "memory" */
    char sha256[65];  /* of the table's bytes as stored in a file, in hexadecimal */
    uint32_t theta_h, theta_d, phi_d;
    uint64_t cells;         /* theta_h * theta_d * phi_d */
    uint64_t invalid_cells; /* with a negative channel */
    uint64_t filled_cells;  /* of them, those above the horizon: holes in the measurement */
} smx_brdf_info;
#define SMX_BRDF_INFO_INIT \
    { sizeof(smx_brdf_info), "", "", "", 0, 0, 0, 0, 0, 0 }

/* Opens a MERL `.binary` file, or a built-in analytic material: "builtin:two-layer" (a rough coloured body under a
 * sharp white gloss), "builtin:conductor" (one rough metal lobe), "builtin:mirror" (reflects all light, from
 * facets within a few thousandths of a radian), or one by formula:
 *   "analytic:beckmann,alpha=A,f0=F", "analytic:ggx,alpha=A,f0=F", "analytic:blinn-phong,exponent=E,f0=F":
 *       f = (F + (1 - F)(1 - cos theta_d)^5) D G2 / (4 cos_i cos_o), height-correlated Smith, Schlick's Fresnel curve;
 *       A 1e-3..10, E 0..1e6; Blinn-Phong's D = (E + 2) / (2 pi) cos^E, its projected area integrated numerically
 *   "analytic:lambert,albedo=F": f = F / pi
 * F is one number in 0..1, or three for r, g, b joined by slashes. Cells with a negative channel are invalid; they are
 * filled from their nearest valid neighbours so that interpolation never mixes them in.
 * Statuses: INVALID_ARGUMENT (also a built-in or a formula that does not exist, a key that is unknown, missing,
 * repeated or out of its range), CANNOT_READ, BAD_FORMAT (dimensions, length, a NaN or an infinity, no valid cell),
 * OUT_OF_MEMORY. */
SMX_API smx_status smx_brdf_open(const char *path_or_builtin, smx_brdf *brdf);

/* The same from memory. values: [3][90][90][phi_d] in 1/sr (not the file's scaled units), negative = invalid;
 * phi_d: 180 or 360; name: shown in reports. The values are copied.
 * Statuses: INVALID_ARGUMENT, BAD_FORMAT (a NaN or an infinity, no valid cell), OUT_OF_MEMORY. */
SMX_API smx_status smx_brdf_create(const char *name, uint32_t phi_d, const double *values, smx_brdf *brdf);
SMX_API smx_status smx_brdf_retain(smx_brdf brdf);
SMX_API void smx_brdf_release(smx_brdf brdf);
SMX_API smx_status smx_brdf_get_info(smx_brdf brdf, smx_brdf_info *info);

/* Copies the table, holes filled: [3][theta_h][theta_d][phi_d] in 1/sr; `count` must be its number of values.
 * Statuses: INVALID_ARGUMENT. */
SMX_API smx_status smx_brdf_get_values(smx_brdf brdf, double *values, size_t count);

/* Writes a MERL `.binary`; cells that were invalid hold -1 again. Atomic: the file is whole or untouched.
 * Statuses: INVALID_ARGUMENT, CANNOT_WRITE. */
SMX_API smx_status smx_brdf_write(smx_brdf brdf, const char *path);

/* ------------------------------------------------------------------------------------------------- slope density */

/* How masking and shadowing relate at wi = wo in the table, for the inversion's kernel. */
typedef enum smx_masking_kernel {
    SMX_MASKING_COINCIDES = 0, /* G2(o,o) = G1(o): real surfaces (Dupuy et al. 2015, section 3) */
    SMX_MASKING_CORRELATED = 1 /* G2(o,o) of height-correlated Smith: tables made with that formula */
} smx_masking_kernel;

typedef struct smx_inversion_options {
    size_t size;
    smx_masking_kernel masking_kernel;
    double tolerance;        /* stop when the density changes by less than this (relative L1), > 0 */
    uint32_t max_iterations; /* 1..100000; reaching it is reported, not an error */
} smx_inversion_options;
#define SMX_INVERSION_OPTIONS_INIT \
    { sizeof(smx_inversion_options), SMX_MASKING_COINCIDES, 1e-10, 1000 }

/* The radial slope density of a BRDF, by power iteration on its retro-reflection, and one Fresnel curve per channel
 * (Dupuy, Heitz, Iehl, Poulin, Ostromoukhov: "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials
 * with Power Iterations", EGSR 2015). Keeps the BRDF alive. Immutable. */
typedef struct smx_density_s *smx_density;

typedef struct smx_density_info {
    size_t size;
    uint32_t nodes;         /* of the slope density */
    uint32_t fresnel_knots; /* theta_d = k pi/180, k = 0..knots-1 */
    uint32_t iterations;
    int converged;
    double change;   /* relative L1 change of the last iteration */
    double alpha;    /* sqrt of the mean squared slope: the one-lobe fit */
    char sha256[65]; /* of the table, as smx_brdf_info has it, or of the CSV file; "" for a density from samples */
} smx_density_info;
#define SMX_DENSITY_INFO_INIT \
    { sizeof(smx_density_info), 0, 0, 0, 0, 0.0, 0.0, "" }

/* Cells whose sum of channels is more than 30 times the median of their row in phi_d, and of the rows beside it in
 * theta_h, are taken for faults: the inversion, and fits to the density, see them filled like holes. References and
 * errors are those of the table as it is.
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (no retro-reflection at all), OUT_OF_MEMORY. */
SMX_API smx_status smx_density_create(smx_brdf brdf, const smx_inversion_options *options, smx_density *density);

/* What a sampled density is over. */
typedef enum smx_density_kind {
    SMX_DENSITY_P22 = 0, /* the slope plane */
    SMX_DENSITY_NDF = 1  /* normals: ndf = p22 / cos^4(theta) */
} smx_density_kind;

#define SMX_MAX_DENSITY_SAMPLES 1048576

/* A density that is from no BRDF: `count` samples, 2..SMX_MAX_DENSITY_SAMPLES; theta in radians, ascending in 0..pi/2;
 * values 0..1e30 in any unit. Both arrays are copied. Linear between the samples, level below the first, 0 beyond the
 * last; brought to the inversion's nodes and normalised; F is 1. Such a density takes the shared model only.
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (0 at every node), OUT_OF_MEMORY. */
SMX_API smx_status smx_density_from_samples(const char *name, smx_density_kind kind, size_t count, const double *theta,
                                            const double *values, smx_density *density);

/* The same from a CSV file of two columns (docs/density-format.md), at most 16 MiB; named like the file, whose sha256
 * goes to the materials that are fitted. Statuses: INVALID_ARGUMENT, CANNOT_READ, BAD_FORMAT (the message has the
 * line's number), NO_SOLUTION, OUT_OF_MEMORY. */
SMX_API smx_status smx_density_read_csv(const char *path, smx_density *density);
SMX_API smx_status smx_density_retain(smx_density density);
SMX_API void smx_density_release(smx_density density);
SMX_API smx_status smx_density_get_info(smx_density density, smx_density_info *info);

/* The density on its nodes: slope (>= 0), p22 (density over the slope plane), mass (share of the nodes' rings, sums to
 * 1). Each array holds `nodes` values; any may be NULL. Statuses: INVALID_ARGUMENT. */
SMX_API smx_status smx_density_get_nodes(smx_density density, double *slope, double *p22, double *mass, size_t nodes);

/* ------------------------------------------------------------------------------------------- mixture and material */

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

/* ------------------------------------------------------------------------------------------- errors in BRDF space */

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

/* ----------------------------------------------------------------------------------------------- scene and rendering */

/* The displaced surface X: a Gaussian density of slopes. */
typedef struct smx_displacement {
    double alpha_x, alpha_y;           /* finite, 0..1e4; 0 is legal in either or both */
    double rho;                        /* correlation of the two slopes, -1 < rho < 1 */
    double mean_slope_x, mean_slope_y; /* finite, -1e4..1e4 */
} smx_displacement;

/* The surface with the slopes of x and of y, which are independent, such as two scales of roughness: means and
 * covariances add, so that a material widened by the sum is one widened by x and then by y. `sum` may be x or y.
 * Statuses: INVALID_ARGUMENT (also a sum that is out of range). */
SMX_API smx_status smx_displacement_add(const smx_displacement *x, const smx_displacement *y, smx_displacement *sum);

typedef enum smx_masking {
    SMX_G2_CORRELATED = 0, /* height-correlated Smith */
    SMX_G2_SEPARABLE = 1   /* G1(wi) G1(wo) */
} smx_masking;

typedef enum smx_light {
    SMX_LIGHT_DIRECTIONAL = 0, /* of unit perpendicular irradiance */
    SMX_LIGHT_UNIFORM = 1      /* radiance 1 from every direction above: a furnace. Of smx_render_filtered,
                                  reference and geometric, by samples of every pixel */
} smx_light;

/* A unit sphere that fills the smaller side of the image, orthographic camera on +y looking along -y, right = +x,
 * up = +z; a directional light in the plane z = 0, or a uniform one. */
typedef struct smx_scene {
    size_t size;
    uint32_t width, height; /* 1..16384 */
    double light_phi;       /* finite; pi/2 is at the camera, 0 at the right, negative behind */
    smx_displacement displacement;
    smx_masking masking;
    smx_light light;
} smx_scene;
#define SMX_SCENE_INIT                                                                                 \
    {                                                                                                  \
        sizeof(smx_scene), 128, 128, 1.5707963267948966, {0.0, 0.0, 0.0, 0.0, 0.0}, SMX_G2_CORRELATED, \
            SMX_LIGHT_DIRECTIONAL                                                                      \
    }

/* Where the reference's facets come from. Where one alpha is 0, every sampler spreads all samples along the other axis;
 * where both are, one sample is exact. Under a uniform light a sample is a facet of X and a direction to the light: mis
 * draws directions from the table's mixture about the facet, sobol from a wide lobe and the cosine, whatever the table
 * is; the grid is INVALID_ARGUMENT. */
typedef enum smx_sampler {
    SMX_SAMPLER_GRID = 0,  /* n x n jittered strata of X's slopes; no estimate of the error */
    SMX_SAMPLER_SOBOL = 1, /* X's slopes from Owen-scrambled Sobol points */
    SMX_SAMPLER_MIS = 2    /* the default: half of them from X, half from the base material's own mixture about the half
                            * vector, joined by the balance heuristic */
} smx_sampler;

/* How exact the arithmetic of the kernels is. */
typedef enum smx_grade {
    SMX_GRADE_PRECISE = 0, /* float, elementary functions to about 2 units in the last place */
    SMX_GRADE_FAST = 1,    /* float, elementary functions to about 1e-4 */
    SMX_GRADE_DOUBLE = 2   /* double, slow, for checking; pixels are still float32. Needs cl_khr_fp64 on the device */
} smx_grade;

/* How a lobe is widened by X: in closed form, order 0 (Dupuy 2015, chapter 5), or by n x n Gauss-Hermite nodes, order n
 * of 1..8, which converges to the integral over X's facets (docs/widening.md). Auto takes for every lobe the least
 * order that an estimate from a few pixels allows. */
#define SMX_WIDENING_MAX_ORDER 8
#define SMX_WIDENING_AUTO (-1)

/* What is simulated, and can be left out (docs/effects.md); a set of effects is a sum of these. */
typedef enum smx_effect {
    SMX_EFFECT_MASKING = 1,            /* facets are hidden from the viewer */
    SMX_EFFECT_SHADOWING = 2,          /* and from the light */
    SMX_EFFECT_HEIGHT_CORRELATION = 4, /* of both, by a facet's height; without: each for itself, SMX_G2_SEPARABLE */
    SMX_EFFECT_FRESNEL = 8,            /* curves over theta_d; without: what they are at 0 */
    SMX_EFFECT_LOBE_COLOR = 16,        /* of the per-lobe model; without: one curve, the lobes' sum, and one masking */
    SMX_EFFECT_ANISOTROPY = 32,        /* X has two alphas and rho; without: the mean of its variances */
    SMX_EFFECT_MEAN_SLOPE = 64,        /* X has a mean slope */
    SMX_EFFECT_INTERREFLECTION = 128   /* light meets more than one facet */
} smx_effect;
#define SMX_EFFECT_COUNT 8

/* In place of a set: all that the integrator supports (and scene->masking asks for); or what the image calls for, all
 * but what together is below a tolerance. */
#define SMX_EFFECTS_NONE UINT32_C(0)
#define SMX_EFFECTS_ALL (UINT32_C(1) << 30)
#define SMX_EFFECTS_AUTO (UINT32_C(1) << 31)

typedef struct smx_render_options {
    size_t size;
    smx_sampler sampler; /* these seven: reference only; but under a uniform light a filtered image has spp, seed,
                            target_error and errors too */
    uint32_t spp;        /* samples per pixel, 1..2^24; a square for the grid, even for mis */
    uint64_t seed;
    smx_lookup lookup;
    double target_error; /* 0 <= target_error < 1; above 0: as many samples, to 2^24, as bring the standard error below
                            it, not spp */
    smx_progress_fn progress; /* or NULL */
    void *progress_user;
    int errors;      /* nonzero: the image carries its standard errors (smx_image_errors); not with the grid, and
                        spp, where it counts, must be a multiple of 16 */
    int whole_table; /* nonzero: each lookup is in the whole table, not in a slice that is cut for the image; slower,
                        and the same but for rounding */
    const char *exr_path; /* not NULL: the image is written to this EXR file as it comes, in bounded memory, and `image`
                             must be NULL. Atomic. Such a file lacks the attribute slopemix.standard_error */
    smx_grade grade;      /* not of smx_render_geometry */
    int32_t widening_order; /* 0..8 or SMX_WIDENING_AUTO: how smx_render_filtered and smx_material_eval widen lobes */
    double widening_tolerance; /* of SMX_WIDENING_AUTO: relRMSE that the widening may add to the image, 0 < it < 1;
                                  measured against order 8, it is no better than that: about 0.003 */
    uint32_t effects;          /* a set, SMX_EFFECTS_ALL or SMX_EFFECTS_AUTO. Filtered shading supports all but
                                  interreflection; the reference all but that, fresnel and lobe-color, which are the
                                  table's; the geometric reference masking, shadowing, anisotropy, mean-slope and, with
                                  bounces, interreflection. A set with another is INVALID_ARGUMENT; so is
                                  height-correlation with SMX_G2_SEPARABLE. Auto leaves out of filtered images what
                                  smx_material_effects says, and of the geometric reference interreflection alone;
                                  for the statistical one, under a uniform light, and where there is no image
                                  (smx_material_eval), it is all
                                */
    double effect_tolerance;   /* of SMX_EFFECTS_AUTO: relRMSE of the image without all that is left out, 0 <= it < 1 */
} smx_render_options;
#define SMX_RENDER_OPTIONS_INIT                                                                                \
    {                                                                                                          \
        sizeof(smx_render_options), SMX_SAMPLER_MIS, 65536, 0, SMX_LOOKUP_LINEAR, 0.0, NULL, NULL, 0, 0, NULL, \
            SMX_GRADE_PRECISE, 0, 0.02, SMX_EFFECTS_AUTO, 1e-3                                                 \
    }

typedef struct smx_render_report {
    size_t size;
    double seconds;        /* the whole call */
    double kernel_seconds; /* on the busiest device, from OpenCL's events */
    double build_seconds;  /* compiling kernels that were not built yet, on the device that took longest */
    uint64_t evaluations;  /* of the shading or the integrand: pixels (lit ones in a reference) times samples */
    uint32_t spp;          /* samples per pixel of a reference, or under a uniform light; 0 for the others */
    double standard_error; /* of these, from independent scrambles: root mean square over the image's. Negative
                            * where there is no estimate: the grid, or a number of samples that 16 does not divide */
    uint8_t widening_orders[SMX_MAX_LOBES]; /* of a filtered image: of each lobe, in ascending alpha */
    double unsettled; /* of a filtered image: share of the lit pixels where a lobe's nodes were placed by Newton steps
                         whose last still promised more than 0.01 of the integrand's logarithm; under a uniform
                         light, of the samples */
    uint32_t effects; /* simulated: a set. 0 of smx_render_geometry */
    uint32_t lobes;   /* of a filtered image: lobes that were shaded, all but those that auto left out; else 0 */
    double interreflection; /* of smx_render_geometric with SMX_EFFECTS_AUTO and bounces: relRMSE of the image without
                               interreflection, from a pilot, which is left out up to effect_tolerance. Negative: not
                               judged */
} smx_render_report;
#define SMX_RENDER_REPORT_INIT \
    { sizeof(smx_render_report), 0.0, 0.0, 0.0, 0, 0, 0.0, {0}, 0.0, 0, 0, 0.0 }

typedef struct smx_image_s *smx_image;

/* The mixture widened by X, in closed form or as options->widening_order says, one evaluation per pixel; under a
 * uniform light options->spp of them, which takes no SMX_WIDENING_AUTO: the integral of f cos over all light, from
 * directions that the widened lobes reflect, with standard errors as a reference's. `report` may be NULL, and `image`
 * must be where options->exr_path takes the image. Statuses: INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR,
 * OUT_OF_MEMORY, CANCELLED, CANNOT_WRITE. */
SMX_API smx_status smx_render_filtered(smx_context context, smx_material material, const smx_scene *scene,
                                       const smx_render_options *options, smx_image *image, smx_render_report *report);

/* What an image by smx_render_filtered calls for: a verdict on each effect, in the order of smx_effect. */
typedef struct smx_effect_verdict {
    smx_effect effect;
    int supported;       /* by filtered shading */
    int on;              /* simulated, with these options */
    double contribution; /* relRMSE of the image with all effects but this one, as estimated; negative: no estimate, as
                            for what is not supported, for height-correlation with SMX_G2_SEPARABLE, or where the
                            image is black */
    char reason[160];    /* a sentence with its number */
} smx_effect_verdict;

typedef struct smx_effect_report {
    size_t size;
    smx_effect_verdict verdicts[SMX_EFFECT_COUNT];
    uint32_t lobes;                /* that are shaded */
    uint8_t shaded[SMX_MAX_LOBES]; /* 1 for each of them, in ascending alpha */
    double left_out;               /* relRMSE of the image without all that is left out, as estimated */
    double seconds;                /* of the judgement; 0 where it was kept from an earlier call */
} smx_effect_report;
#define SMX_EFFECT_REPORT_INIT \
    { sizeof(smx_effect_report), {{SMX_EFFECT_MASKING, 0, 0, 0.0, ""}}, 0, {0}, 0.0, 0.0 }

/* Judges the effects of an image before it is rendered, on some of its pixels, in closed form and in double on the
 * host: with SMX_EFFECTS_AUTO as smx_render_filtered does, and else what the named set leaves out. Judgements are kept
 * with the material. `options` may be NULL. Statuses: INVALID_ARGUMENT, OUT_OF_MEMORY. */
SMX_API smx_status smx_material_effects(smx_material material, const smx_scene *scene,
                                        const smx_render_options *options, smx_effect_report *report);

/* "masking", "shadowing", ... as on the command line; NULL for another number. The text is the library's. */
SMX_API const char *smx_effect_name(smx_effect effect);

/* The statistical reference: the measured table integrated over X's facets. The sampler mis fits the table's own
 * mixture at the image's theta_d when it is first used there. Same statuses. */
SMX_API smx_status smx_render_reference(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                        const smx_render_options *options, smx_image *image, smx_render_report *report);

/* The geometric reference's surface, and how far it follows light. */
typedef struct smx_geometric_options {
    size_t size;
    uint32_t tile; /* cells along a side of the tile: a power of two, 64..8192, that the device's memory holds */
    uint32_t realisations; /* independent tiles, 1..65536, with an equal share of the samples each */
    uint32_t bounces; /* interreflection: facets, after the first one seen, that light may have met, 0..1024; 0 also
                           where options->effects leaves interreflection out */
} smx_geometric_options;
#define SMX_GEOMETRIC_OPTIONS_INIT \
    { sizeof(smx_geometric_options), 1024, 16, 0 }

/* The geometric reference: rays against realisations of a displaced surface, a tileable Gaussian random height field
 * whose facets have X's slopes (docs/geometric.md). Masking and shadowing are what rays meet; scene->masking has no
 * part in it. Of the options, spp (a multiple of the realisations), seed, lookup, errors, exr_path and progress count;
 * target_error must be 0. The standard error, absent for one realisation, is from the spread of the realisations, and
 * so has the tile's own share. `geometric` may be NULL. Statuses: those of smx_render_reference, which it fits the
 * table's mixture like where paths go on. */
SMX_API smx_status smx_render_geometric(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                        const smx_render_options *options, const smx_geometric_options *geometric,
                                        smx_image *image, smx_render_report *report);

/* A picture of the displaced sphere: smx_render_geometric's height field, exaggerated and lit so that its shape shows.
 * Same statuses. */
SMX_API smx_status smx_render_geometry(smx_context context, const smx_scene *scene, const smx_render_options *options,
                                       smx_image *image, smx_render_report *report);

/* A way to make an image: one that smx_choose picked or tried. */
typedef struct smx_configuration {
    int32_t material;       /* filtered, by materials[material] and `widening_order`; or SMX_BY_REFERENCE, */
    int32_t widening_order; /*   by `sampler` and `spp` */
    smx_sampler sampler;
    uint32_t spp;
    double error;   /* relRMSE of the image against the converged reference of the table, as predicted */
    double seconds; /* smx_render_report.kernel_seconds of the image, as predicted */
} smx_configuration;
#define SMX_BY_REFERENCE (-1)
#define SMX_CONFIGURATION_INIT \
    { SMX_BY_REFERENCE, 0, SMX_SAMPLER_MIS, 0, 0.0, 0.0 }

typedef struct smx_choose_options {
    size_t size;
    double max_error;      /* the cheapest of at most this error, 0 < it <= 1; or 0, and */
    double max_seconds;    /*   the most accurate of at most these kernel_seconds, above 0; one of both */
    uint32_t pilot_pixels; /* pixels of the image that configurations are tried on, 16..65536; fewer where fewer are
                              lit */
} smx_choose_options;
#define SMX_CHOOSE_OPTIONS_INIT \
    { sizeof(smx_choose_options), 0.0, 0.0, 512 }

#define SMX_MAX_CHOOSE_MATERIALS 16
#define SMX_MAX_TRIED 192

typedef struct smx_choice {
    size_t size;
    smx_configuration picked;
    int has_cheaper, has_better; /* nonzero: the next two are there */
    smx_configuration cheaper;   /* of those tried that cost less, the most accurate */
    smx_configuration better;    /* the cheapest that is known, or extrapolated, to be more accurate */
    uint32_t tried_count;
    smx_configuration tried[SMX_MAX_TRIED];
    char reason[512];      /* a sentence: what was picked, and why */
    uint32_t pilot_pixels; /* that were tried on */
    double pilot_error;    /* standard error of what they were compared with; negative without a table */
    double device_speed;   /* seconds on this device over those of the library's own table of costs */
    double seconds, kernel_seconds, build_seconds; /* of the choice, as in smx_render_report */
} smx_choice;
#define SMX_CHOICE_INIT                                                                                      \
    {                                                                                                        \
        sizeof(smx_choice), SMX_CONFIGURATION_INIT, 0, 0, SMX_CONFIGURATION_INIT, SMX_CONFIGURATION_INIT, 0, \
            {SMX_CONFIGURATION_INIT}, "", 0, -1.0, 1.0, 0.0, 0.0, 0.0                                        \
    }

/* Chooses how to make an image by its error or its time (docs/choosing.md). Configurations are tried, cheapest first,
 * on a pilot: pixels of the scene itself, where enough samples of the table say what is true. They are `material_count`
 * materials, 0..SMX_MAX_CHOOSE_MATERIALS, by some orders of widening, and the reference of `brdf` by every sampler and
 * powers of two of samples. `brdf` may be NULL: the materials' fit reports then say how far they are from their table,
 * an upper bound as a rule. Of `render`, which may be NULL, seed, lookup, grade and progress count, and must be
 * those of the image; the prediction is for that seed, and for an image of all effects: what SMX_EFFECTS_AUTO leaves
 * out of a filtered one, up to its tolerance, comes on top.
 * Statuses: INVALID_ARGUMENT, NO_SOLUTION (no configuration will do: the message has the nearest, its error and its
 * seconds; a material without a fit to a table, where there is no brdf), KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY,
 * CANCELLED. */
SMX_API smx_status smx_choose(smx_context context, smx_brdf brdf, const smx_material *materials, size_t material_count,
                              const smx_scene *scene, const smx_render_options *render,
                              const smx_choose_options *options, smx_choice *choice);

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

/* ------------------------------------------------------------------------------------------------------------- images */

/* rgba: [height][width][4], copied, or NULL for a black image with alpha 0. Sides 1..16384.
 * Statuses: INVALID_ARGUMENT, OUT_OF_MEMORY. */
SMX_API smx_status smx_image_create(uint32_t width, uint32_t height, const float *rgba, smx_image *image);
SMX_API smx_status smx_image_retain(smx_image image);
SMX_API void smx_image_release(smx_image image);
SMX_API smx_status smx_image_get_size(smx_image image, uint32_t *width, uint32_t *height);

/* The pixels, [height][width][4], owned by the image and valid while it lives; NULL for a null image. */
SMX_API const float *smx_image_pixels(smx_image image);

/* Standard errors of a reference that was rendered with options.errors, or read from such a file: of R, G and B, and
 * the pixel's alpha, [height][width][4]. Owned by the image; NULL where there are none. They are those of a mean of
 * eight scrambles, or of a geometric reference's realisations: an interval is Student's, of 7 degrees of freedom, or of
 * one less than the realisations. Of 2000 trials with 4096 samples, intervals of 95 % of the statistical reference held
 * the converged value in 94.6 % (sobol) and 92.9 % (mis; 94 % of 7000 others, of surfaces with two axes): means are a
 * little skewed (tests/test_coverage.cpp). */
SMX_API const float *smx_image_errors(smx_image image);

/* Header attributes, written to EXR and read back. Keys: 1..255 characters, not one of EXR's own names. A rendered
 * image carries its configuration under "slopemix.*".
 * Statuses: INVALID_ARGUMENT. smx_image_get_attribute gives a borrowed string, NULL if there is none of that name. */
SMX_API smx_status smx_image_set_attribute(smx_image image, const char *key, const char *value);
SMX_API const char *smx_image_get_attribute(smx_image image, const char *key);

/* EXR: channels R, G, B, A as float32, scan lines, linear; error.R, error.G, error.B too for an image with standard
 * errors. Reading takes any EXR that has R, G and B (alpha 1 where there is no A), and its errors where all three are.
 * Writing is atomic. Statuses: INVALID_ARGUMENT, CANNOT_READ, CANNOT_WRITE, BAD_FORMAT. */
SMX_API smx_status smx_image_read_exr(const char *path, smx_image *image);
SMX_API smx_status smx_image_write_exr(smx_image image, const char *path);

/* 8-bit sRGB display pixels, [height][width][3]: sRGB transfer of clip(exposure * linear) over the blue background.
 * exposure > 0. Statuses: INVALID_ARGUMENT. */
SMX_API smx_status smx_image_display(smx_image image, double exposure, uint8_t *rgb, size_t count);

/* The same as a PNG file. Statuses: INVALID_ARGUMENT, CANNOT_WRITE. */
SMX_API smx_status smx_image_write_png(smx_image image, const char *path, double exposure);

/* The q-quantile (0..1) of the R, G, B values of pixels with alpha > 0, NaNs left out; 0 if there are none.
 * Statuses: INVALID_ARGUMENT. */
SMX_API smx_status smx_image_quantile(smx_image image, double q, double *value);

typedef struct smx_comparison {
    size_t size;
    double relrmse; /* sqrt(mean (a-b)^2) / sqrt(mean b^2); infinity where b is black and a is not, 0 where both are */
    double rmse;
    double max_error; /* largest |a-b| */
    double bias;      /* mean a / mean b; 1 where both are black, infinity where only b is */
    uint64_t pixels;  /* compared: those with alpha > 0 in b */
} smx_comparison;
#define SMX_COMPARISON_INIT \
    { sizeof(smx_comparison), 0.0, 0.0, 0.0, 0.0, 0 }

/* Errors of `image` against `reference` over the pixels with alpha > 0 in the reference and the three channels.
 * Statuses: INVALID_ARGUMENT (also images of different size, or no pixel to compare). */
SMX_API smx_status smx_image_compare(smx_image image, smx_image reference, smx_comparison *comparison);

#ifdef __cplusplus
}
#endif
#endif
