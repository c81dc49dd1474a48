/** @file
 * How to make an image, by its error or its time. (Part of slopemix.h.) */
#ifndef SLOPEMIX_CHOOSE_H
#define SLOPEMIX_CHOOSE_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A way to make an image: one that smx_choose picked or tried. */
typedef struct smx_configuration {
    int32_t material; /**< filtered, by materials[material] and widening_order; or SMX_BY_REFERENCE, by sampler and
                           spp */
    int32_t widening_order; /**< of a filtered image */
    smx_sampler sampler;    /**< of a reference */
    uint32_t spp;           /**< of a reference */
    double error;           /**< relRMSE of the image against the converged reference of the table, as predicted */
    double seconds;         /**< smx_render_report.kernel_seconds of the image, as predicted */
} smx_configuration;
/** In place of a material's index: by smx_render_reference. */
#define SMX_BY_REFERENCE (-1)
/** Initialiser of smx_configuration. */
#define SMX_CONFIGURATION_INIT \
    { SMX_BY_REFERENCE, 0, SMX_SAMPLER_MIS, 0, 0.0, 0.0 }

/** What is asked for: max_error or max_seconds, one of both. */
typedef struct smx_choose_options {
    size_t size;           /**< sizeof(smx_choose_options) */
    double max_error;      /**< the cheapest of at most this error, 0 < it <= 1; or 0 */
    double max_seconds;    /**< the most accurate of at most these kernel_seconds, above 0; or 0 */
    uint32_t pilot_pixels; /**< pixels of the image that configurations are tried on, 16..65536; fewer where fewer are
                                lit */
} smx_choose_options;
/** Defaults of smx_choose_options, of which max_error or max_seconds must be set. */
#define SMX_CHOOSE_OPTIONS_INIT \
    { sizeof(smx_choose_options), 0.0, 0.0, 512 }

/** Most materials that smx_choose takes. */
#define SMX_MAX_CHOOSE_MATERIALS 16
/** Most configurations that it tries. */
#define SMX_MAX_TRIED 192

/** What was chosen, and among what. */
typedef struct smx_choice {
    size_t size;                            /**< sizeof(smx_choice) */
    smx_configuration picked;               /**< the choice */
    int has_cheaper;                        /**< nonzero: `cheaper` is there */
    int has_better;                         /**< nonzero: `better` is there */
    smx_configuration cheaper;              /**< of those tried that cost less, the most accurate */
    smx_configuration better;               /**< the cheapest that is known, or extrapolated, to be more accurate */
    uint32_t tried_count;                   /**< of `tried` */
    smx_configuration tried[SMX_MAX_TRIED]; /**< all that were tried */
    char reason[512];                       /**< a sentence: what was picked, and why */
    uint32_t pilot_pixels;                  /**< that were tried on */
    double pilot_error;    /**< standard error of what they were compared with; negative without a table */
    double device_speed;   /**< seconds on this device over those of the library's own table of costs */
    double seconds;        /**< of the choice, as in smx_render_report; */
    double kernel_seconds; /**< likewise; */
    double build_seconds;  /**< likewise */
} smx_choice;
/** Initialiser of smx_choice. */
#define SMX_CHOICE_INIT                                                                                      \
    {                                                                                                        \
        sizeof(smx_choice), SMX_CONFIGURATION_INIT, 0, 0, SMX_CONFIGURATION_INIT, SMX_CONFIGURATION_INIT, 0, \
            {SMX_CONFIGURATION_INIT}, "", 0, -1.0, 1.0, 0.0, 0.0, 0.0                                        \
    }

/** Chooses how to make an image by its error or its time. Configurations are tried, cheapest first, on a pilot: pixels
 * of the scene itself, where enough samples of the table say what is true. They are the materials, by some orders of
 * widening, and the reference of the table by every sampler and powers of two of samples. The prediction is for an
 * image of all effects: what SMX_EFFECTS_AUTO leaves out of a filtered one, up to its tolerance, comes on top. Source:
 * docs/choosing.md.
 *
 * @param context         where it is tried, and will be rendered
 * @param brdf            the table; or NULL: the materials' fit reports then say how far they are from their table, an
 *                        upper bound as a rule
 * @param materials       [material_count]
 * @param material_count  0..SMX_MAX_CHOOSE_MATERIALS
 * @param scene           the image
 * @param render          seed, lookup, grade and progress count, and must be those of the image. NULL: the defaults
 * @param options         what is asked for
 * @param choice          written; its size field must be set
 * @threads   any; calls on one context run one after another
 * @statuses  INVALID_ARGUMENT, NO_SOLUTION (no configuration will do: the message has the nearest, its error and its
 *            seconds; a material without a fit to a table, where there is no brdf), KERNEL_BUILD, DEVICE_ERROR,
 *            OUT_OF_MEMORY, CANCELLED */
SMX_API smx_status smx_choose(smx_context context, smx_brdf brdf, const smx_material *materials, size_t material_count,
                              const smx_scene *scene, const smx_render_options *render,
                              const smx_choose_options *options, smx_choice *choice);

#ifdef __cplusplus
}
#endif
#endif
