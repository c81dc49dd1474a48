/** @file
 * Which effects an image calls for. (Part of slopemix.h.) */
#ifndef SLOPEMIX_EFFECTS_H
#define SLOPEMIX_EFFECTS_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is said of one effect in an image by smx_render_filtered. */
typedef struct smx_effect_verdict {
    smx_effect effect;   /**< which */
    int supported;       /**< by filtered shading */
    int on;              /**< simulated, with these options */
    double contribution; /**< relRMSE of the image with all effects but this one, as estimated; negative: no estimate,
                            as for what is not supported, for height-correlation with SMX_G2_SEPARABLE, or where the
                              image is black */
    char reason[160];    /**< a sentence with its number */
} smx_effect_verdict;

/** What an image by smx_render_filtered calls for. */
typedef struct smx_effect_report {
    size_t size;                                   /**< sizeof(smx_effect_report) */
    smx_effect_verdict verdicts[SMX_EFFECT_COUNT]; /**< on each effect, in the order of smx_effect */
    uint32_t lobes;                                /**< that are shaded */
    uint8_t shaded[SMX_MAX_LOBES];                 /**< 1 for each of them, in ascending alpha */
    double left_out; /**< relRMSE of the image without all that is left out, as estimated */
    double seconds;  /**< of the judgement; 0 where it was kept from an earlier call */
} smx_effect_report;
/** Initialiser of smx_effect_report. */
#define SMX_EFFECT_REPORT_INIT \
    { sizeof(smx_effect_report), {{SMX_EFFECT_MASKING, 0, 0, 0.0, ""}}, 0, {0}, 0.0, 0.0 }

/** Judges the effects of an image before it is rendered, on some of its pixels, in closed form and in double on the
 * host: with SMX_EFFECTS_AUTO as smx_render_filtered does, and else what the named set leaves out. Judgements are kept
 * with the material. Source: docs/effects.md.
 *
 * @param material  the material
 * @param scene     the image
 * @param options   of the image; NULL: the defaults
 * @param report    written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT, OUT_OF_MEMORY */
SMX_API smx_status smx_material_effects(smx_material material, const smx_scene *scene,
                                        const smx_render_options *options, smx_effect_report *report);

/** "masking", "shadowing", ... as on the command line.
 *
 * @param effect  one effect
 * @return        its name; NULL for another number
 * @ownership     the library's, valid for ever
 * @threads       any */
SMX_API const char *smx_effect_name(smx_effect effect);

#ifdef __cplusplus
}
#endif
#endif
