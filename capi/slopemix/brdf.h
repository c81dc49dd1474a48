/** @file
 * Measured BRDFs. (Part of slopemix.h.) */
#ifndef SLOPEMIX_BRDF_H
#define SLOPEMIX_BRDF_H

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a table is read between its nodes. */
typedef enum smx_lookup {
    SMX_LOOKUP_LINEAR = 0, /**< values at the nodes (k/90)^2 pi/2, k pi/180, k pi/180; linear in (sqrt theta_h, ...) */
    SMX_LOOKUP_NEAREST = 1 /**< the cell that holds the angles, as in the lookup code that came with MERL */
} smx_lookup;

/** An isotropic measured BRDF on the MERL grid (Matusik et al. 2003): [rgb][theta_h][theta_d][phi_d]. Immutable. */
typedef struct smx_brdf_s *smx_brdf;

/** Facts about a table. */
typedef struct smx_brdf_info {
    size_t size;      /**< sizeof(smx_brdf_info) */
    char name[128];   /**< file name without its ending, or what follows "builtin:" or "analytic:", with _ for / */
    char source[512]; /**< path, "builtin:NAME", "analytic:...", or "memory" */
    char sha256[65];  /**< of the table's bytes as stored in a file, in hexadecimal */
    uint32_t theta_h; /**< values along theta_h: 90 */
    uint32_t theta_d; /**< along theta_d: 90 */
    uint32_t phi_d;   /**< along phi_d: 180 or 360 */
    uint64_t cells;   /**< theta_h * theta_d * phi_d */
    uint64_t invalid_cells; /**< with a negative channel */
    uint64_t filled_cells;  /**< of them, those above the horizon: holes in the measurement */
} smx_brdf_info;
/** Initialiser of smx_brdf_info. */
#define SMX_BRDF_INFO_INIT \
    { sizeof(smx_brdf_info), "", "", "", 0, 0, 0, 0, 0, 0 }

/** Opens a MERL `.binary` file, or a built-in analytic material: "builtin:two-layer" (a rough coloured body under a
 * sharp white gloss), "builtin:conductor" (one rough metal lobe), "builtin:mirror" (reflects all light, from
 * facets within a few thousandths of a radian), or one by formula:
 *   - "analytic:beckmann,alpha=A,f0=F", "analytic:ggx,alpha=A,f0=F", "analytic:blinn-phong,exponent=E,f0=F":
 *     f = (F + (1 - F)(1 - cos theta_d)^5) D G2 / (4 cos_i cos_o), height-correlated Smith, Schlick's Fresnel curve;
 *     A 1e-3..10, E 0..1e6; Blinn-Phong's D = (E + 2) / (2 pi) cos^E, its projected area integrated numerically
 *   - "analytic:lambert,albedo=F": f = F / pi
 *
 * F is one number in 0..1, or three for r, g, b joined by slashes. Cells with a negative channel are invalid; they are
 * filled from their nearest valid neighbours so that interpolation never mixes them in.
 *
 * @param path_or_builtin  path of the file, or one of the names above
 * @param brdf             the new handle
 * @ownership  the caller owns one reference of `*brdf`
 * @threads    any
 * @statuses   INVALID_ARGUMENT (also a built-in or a formula that does not exist, a key that is unknown, missing,
 *             repeated or out of its range), CANNOT_READ, BAD_FORMAT (dimensions, length, a NaN or an infinity, no
 *             valid cell), OUT_OF_MEMORY */
SMX_API smx_status smx_brdf_open(const char *path_or_builtin, smx_brdf *brdf);

/** The same from memory.
 *
 * @param name    shown in reports
 * @param phi_d   180 or 360
 * @param values  [3][90][90][phi_d] in 1/sr (not the file's scaled units), negative = invalid
 * @param brdf    the new handle
 * @ownership  the caller owns one reference of `*brdf`; the values are copied
 * @threads    any
 * @statuses   INVALID_ARGUMENT, BAD_FORMAT (a NaN or an infinity, no valid cell), OUT_OF_MEMORY */
SMX_API smx_status smx_brdf_create(const char *name, uint32_t phi_d, const double *values, smx_brdf *brdf);

/** Adds a reference.
 *
 * @param brdf  the handle
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_brdf_retain(smx_brdf brdf);

/** Drops a reference.
 *
 * @param brdf  the handle, or NULL
 * @threads  any */
SMX_API void smx_brdf_release(smx_brdf brdf);

/** Facts about a table.
 *
 * @param brdf  the table
 * @param info  written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_brdf_get_info(smx_brdf brdf, smx_brdf_info *info);

/** Copies the table, holes filled.
 *
 * @param brdf    the table
 * @param values  [3][theta_h][theta_d][phi_d] in 1/sr
 * @param count   number of values, which must be the table's
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_brdf_get_values(smx_brdf brdf, double *values, size_t count);

/** Writes a MERL `.binary`; cells that were invalid hold -1 again. Atomic: the file is whole or untouched.
 *
 * @param brdf  the table
 * @param path  of the file
 * @threads   any
 * @statuses  INVALID_ARGUMENT, CANNOT_WRITE */
SMX_API smx_status smx_brdf_write(smx_brdf brdf, const char *path);

#ifdef __cplusplus
}
#endif
#endif
