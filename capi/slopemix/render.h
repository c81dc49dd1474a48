/** @file
 * Images of the displaced sphere: filtered shading, and the statistical reference. (Part of slopemix.h.) */
#ifndef SLOPEMIX_RENDER_H
#define SLOPEMIX_RENDER_H

#include "brdf.h"
#include "context.h"
#include "image.h"
#include "material.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Where the reference's facets come from. Where one alpha is 0, every sampler spreads all samples along the other
 * axis; where both are, one sample is exact. Under a uniform light a sample is a facet of X and a direction to the
 * light: mis draws directions from the table's mixture about the facet, sobol from a wide lobe and the cosine, whatever
 * the table is; the grid is INVALID_ARGUMENT. */
typedef enum smx_sampler {
    SMX_SAMPLER_GRID = 0,  /**< n x n jittered strata of X's slopes; no estimate of the error */
    SMX_SAMPLER_SOBOL = 1, /**< X's slopes from Owen-scrambled Sobol points */
    SMX_SAMPLER_MIS = 2 /**< the default: half of them from X, half from the base material's own mixture about the half
                         * vector, joined by the balance heuristic */
} smx_sampler;

/** How exact the arithmetic of the kernels is. */
typedef enum smx_grade {
    SMX_GRADE_PRECISE = 0, /**< float, elementary functions to about 2 units in the last place */
    SMX_GRADE_FAST = 1,    /**< float, elementary functions to about 1e-4 */
    SMX_GRADE_DOUBLE = 2   /**< double, slow, for checking; pixels are still float32. Needs cl_khr_fp64 on the device */
} smx_grade;

/** Highest order of widening. How a lobe is widened by X: in closed form, order 0 (Dupuy 2015, chapter 5), or by n x n
 * Gauss-Hermite nodes, order n of 1..8, which converges to the integral over X's facets (docs/widening.md). */
#define SMX_WIDENING_MAX_ORDER 8
/** In place of an order: for every lobe the least one that an estimate from a few pixels allows. */
#define SMX_WIDENING_AUTO (-1)

/** What is simulated, and can be left out (docs/effects.md); a set of effects is a sum of these. */
typedef enum smx_effect {
    SMX_EFFECT_MASKING = 1,            /**< facets are hidden from the viewer */
    SMX_EFFECT_SHADOWING = 2,          /**< and from the light */
    SMX_EFFECT_HEIGHT_CORRELATION = 4, /**< of both, by a facet's height; without: each for itself, SMX_G2_SEPARABLE */
    SMX_EFFECT_FRESNEL = 8,            /**< curves over theta_d; without: what they are at 0 */
    SMX_EFFECT_LOBE_COLOR = 16,      /**< of the per-lobe model; without: one curve, the lobes' sum, and one masking */
    SMX_EFFECT_ANISOTROPY = 32,      /**< X has two alphas and rho; without: the mean of its variances */
    SMX_EFFECT_MEAN_SLOPE = 64,      /**< X has a mean slope */
    SMX_EFFECT_INTERREFLECTION = 128 /**< light meets more than one facet */
} smx_effect;
/** Number of effects. */
#define SMX_EFFECT_COUNT 8

/** A set of effects without any. */
#define SMX_EFFECTS_NONE UINT32_C(0)
/** In place of a set: all that the integrator supports (and scene->masking asks for). */
#define SMX_EFFECTS_ALL (UINT32_C(1) << 30)
/** In place of a set: what the image calls for, all but what together is below a tolerance. */
#define SMX_EFFECTS_AUTO (UINT32_C(1) << 31)

/** How an image is made. sampler to progress_user are the reference's, as is whole_table; under a uniform light a
 * filtered image has spp, seed, target_error and errors too. */
typedef struct smx_render_options {
    size_t size;              /**< sizeof(smx_render_options) */
    smx_sampler sampler;      /**< where the facets come from */
    uint32_t spp;             /**< samples per pixel, 1..2^24; a square for the grid, even for mis */
    uint64_t seed;            /**< of what is random: the same seed, the same bits */
    smx_lookup lookup;        /**< how the table is read between its nodes */
    double target_error;      /**< 0 <= it < 1; above 0: as many samples, to 2^24, as bring the standard error below
                                   it, not spp */
    smx_progress_fn progress; /**< or NULL */
    void *progress_user;      /**< what `progress` is given */
    int errors;      /**< nonzero: the image carries its standard errors (smx_image_errors); not with the grid, and
                          spp, where it counts, must be a multiple of 2 scrambles */
    int whole_table; /**< nonzero: each lookup is in the whole table, not in a slice that is cut for the image; slower,
                          and the same but for rounding */
    const char *exr_path;   /**< not NULL: the image is written to this EXR file as it comes, in bounded memory, and
                                 `image` must be NULL. Atomic. Such a file lacks the attribute
                                 slopemix.standard_error */
    smx_grade grade;        /**< not of smx_render_geometry */
    int32_t widening_order; /**< 0..8 or SMX_WIDENING_AUTO: how smx_render_filtered and smx_material_eval widen lobes */
    double widening_tolerance; /**< of SMX_WIDENING_AUTO: relRMSE that the widening may add to the image, 0 < it < 1;
                                  measured against order 8, it is no better than that: about 0.003 */
    uint32_t effects;          /**< a set, SMX_EFFECTS_ALL or SMX_EFFECTS_AUTO. Filtered shading supports all but
                                  interreflection; the reference all but that, fresnel and lobe-color, which are the
                                  table's; the geometric reference masking, shadowing, anisotropy, mean-slope and, with
                                  bounces, interreflection. A set with another is INVALID_ARGUMENT; so is
                                  height-correlation with SMX_G2_SEPARABLE. Auto leaves out of filtered images what
                                  smx_material_effects says, and of the geometric reference interreflection alone;
                                  for the statistical one, under a uniform light, and where there is no image
                                  (smx_material_eval), it is all */
    double effect_tolerance; /**< of SMX_EFFECTS_AUTO: relRMSE of the image without all that is left out, 0 <= it < 1 */
    uint32_t scrambles; /**< 8, 16, 32 or 64: independent ones, in which a reference's samples come and of which its
                             standard errors are. More make these more honest, and as many samples less even; there
                             is no estimate where spp is no multiple of twice as many */
} smx_render_options;
/** Defaults of smx_render_options. */
#define SMX_RENDER_OPTIONS_INIT                                                                                \
    {                                                                                                          \
        sizeof(smx_render_options), SMX_SAMPLER_MIS, 65536, 0, SMX_LOOKUP_LINEAR, 0.0, NULL, NULL, 0, 0, NULL, \
            SMX_GRADE_PRECISE, 0, 0.02, SMX_EFFECTS_AUTO, 1e-3, 8                                              \
    }

/** What making an image took, and how good it is. */
typedef struct smx_render_report {
    size_t size;           /**< sizeof(smx_render_report) */
    double seconds;        /**< the whole call */
    double kernel_seconds; /**< on the busiest device, from OpenCL's events */
    double build_seconds;  /**< compiling kernels that were not built yet, on the device that took longest */
    uint64_t evaluations;  /**< of the shading or the integrand: pixels (lit ones in a reference) times samples */
    uint32_t spp;          /**< samples per pixel of a reference, or under a uniform light; 0 for the others */
    double standard_error; /**< of these, from independent scrambles: root mean square over the image's. Negative
                            * where there is no estimate: the grid, or a number of samples that 16 does not divide */
    uint8_t widening_orders[SMX_MAX_LOBES]; /**< of a filtered image: of each lobe, in ascending alpha */
    double unsettled; /**< of a filtered image: share of the lit pixels where a lobe's nodes were placed by Newton steps
                         whose last still promised more than 0.01 of the integrand's logarithm; under a uniform
                         light, of the samples */
    uint32_t effects; /**< simulated: a set. 0 of smx_render_geometry */
    uint32_t lobes;   /**< of a filtered image: lobes that were shaded, all but those that auto left out; else 0 */
    double interreflection; /**< of smx_render_geometric with SMX_EFFECTS_AUTO and bounces: relRMSE of the image without
                               interreflection, from a pilot, which is left out up to effect_tolerance. Negative: not
                               judged */
} smx_render_report;
/** Initialiser of smx_render_report. */
#define SMX_RENDER_REPORT_INIT \
    { sizeof(smx_render_report), 0.0, 0.0, 0.0, 0, 0, 0.0, {0}, 0.0, 0, 0, 0.0 }

/** Filtered shading: the mixture widened by X, in closed form or as options->widening_order says, one evaluation per
 * pixel; under a uniform light options->spp of them, which takes no SMX_WIDENING_AUTO: the integral of f cos over all
 * light, from directions that the widened lobes reflect, with standard errors as a reference's. Source: Dupuy 2015,
 * chapter 5; docs/widening.md for orders above 0.
 *
 * @param context   where it is rendered
 * @param material  what the sphere is made of
 * @param scene     what is rendered
 * @param options   grade, the widening's, the effects', exr_path and progress count; under a uniform light spp, seed,
 *                  target_error and errors too. NULL: the defaults
 * @param image     the new handle; NULL where options->exr_path takes the image
 * @param report    written, its size field must be set; or NULL
 * @ownership  the caller owns one reference of `*image`
 * @threads    any; calls on one context run one after another
 * @statuses   INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY, CANCELLED, CANNOT_WRITE */
SMX_API smx_status smx_render_filtered(smx_context context, smx_material material, const smx_scene *scene,
                                       const smx_render_options *options, smx_image *image, smx_render_report *report);

/** The statistical reference: the measured table integrated over X's facets. The sampler mis fits the table's own
 * mixture at the image's theta_d when it is first used there. Source: Dupuy 2015, chapter 5.
 *
 * @param context  where it is rendered
 * @param brdf     the table
 * @param scene    what is rendered
 * @param options  all but widening and its tolerance count. NULL: the defaults
 * @param image    the new handle; NULL where options->exr_path takes the image
 * @param report   written, its size field must be set; or NULL
 * @ownership  the caller owns one reference of `*image`
 * @threads    any; calls on one context run one after another
 * @statuses   those of smx_render_filtered */
SMX_API smx_status smx_render_reference(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                        const smx_render_options *options, smx_image *image, smx_render_report *report);

#ifdef __cplusplus
}
#endif
#endif
