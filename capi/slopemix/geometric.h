/** @file
 * The geometric reference: rays against a height field. (Part of slopemix.h.) */
#ifndef SLOPEMIX_GEOMETRIC_H
#define SLOPEMIX_GEOMETRIC_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The geometric reference's surface, and how far it follows light. */
typedef struct smx_geometric_options {
    size_t size;   /**< sizeof(smx_geometric_options) */
    uint32_t tile; /**< cells along a side of the tile: a power of two, 64..8192, that the device's memory holds */
    uint32_t realisations; /**< independent tiles, 1..65536, with an equal share of the samples each */
    uint32_t bounces; /**< interreflection: facets, after the first one seen, that light may have met, 0..1024; 0 also
                           where options->effects leaves interreflection out */
} smx_geometric_options;
/** Defaults of smx_geometric_options. */
#define SMX_GEOMETRIC_OPTIONS_INIT \
    { sizeof(smx_geometric_options), 1024, 16, 0 }

/** The geometric reference: rays against realisations of a displaced surface, a tileable Gaussian random height field
 * whose facets have X's slopes. Masking and shadowing are what rays meet. The standard error, absent for one
 * realisation, is from the spread of the realisations, and so has the tile's own share. Where paths go on, the table's
 * mixture is fitted as by smx_render_reference. Source: docs/geometric.md.
 *
 * @param context    where it is rendered
 * @param brdf       the table
 * @param scene      what is rendered; its masking has no part in it
 * @param options    spp (a multiple of the realisations), seed, lookup, errors, exr_path and progress count;
 *                   target_error must be 0. NULL: the defaults
 * @param geometric  the surface, and how far light is followed. NULL: the defaults
 * @param image      the new handle; NULL where options->exr_path takes the image
 * @param report     written, its size field must be set; or NULL
 * @ownership  the caller owns one reference of `*image`
 * @threads    any; calls on one context run one after another
 * @statuses   those of smx_render_reference */
SMX_API smx_status smx_render_geometric(smx_context context, smx_brdf brdf, const smx_scene *scene,
                                        const smx_render_options *options, const smx_geometric_options *geometric,
                                        smx_image *image, smx_render_report *report);

/** A picture of the displaced sphere: smx_render_geometric's height field, exaggerated and lit so that its shape shows.
 *
 * @param context  where it is rendered
 * @param scene    what is rendered
 * @param options  exr_path and progress count. NULL: the defaults
 * @param image    the new handle; NULL where options->exr_path takes the image
 * @param report   written, its size field must be set; or NULL
 * @ownership  the caller owns one reference of `*image`
 * @threads    any; calls on one context run one after another
 * @statuses   those of smx_render_reference */
SMX_API smx_status smx_render_geometry(smx_context context, const smx_scene *scene, const smx_render_options *options,
                                       smx_image *image, smx_render_report *report);

#ifdef __cplusplus
}
#endif
#endif
