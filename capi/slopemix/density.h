/** @file
 * Slope densities: a measured BRDF inverted, or samples. (Part of slopemix.h.) */
#ifndef SLOPEMIX_DENSITY_H
#define SLOPEMIX_DENSITY_H

#include "brdf.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How masking and shadowing relate at wi = wo in the table, for the inversion's kernel. */
typedef enum smx_masking_kernel {
    SMX_MASKING_COINCIDES = 0, /**< G2(o,o) = G1(o): real surfaces (Dupuy et al. 2015, section 3) */
    SMX_MASKING_CORRELATED = 1 /**< G2(o,o) of height-correlated Smith: tables made with that formula */
} smx_masking_kernel;

/** How a table is inverted. */
typedef struct smx_inversion_options {
    size_t size;                       /**< sizeof(smx_inversion_options) */
    smx_masking_kernel masking_kernel; /**< what the table is of */
    double tolerance;                  /**< stop when the density changes by less than this (relative L1), > 0 */
    uint32_t max_iterations;           /**< 1..100000; reaching it is reported, not an error */
} smx_inversion_options;
/** Defaults of smx_inversion_options. */
#define SMX_INVERSION_OPTIONS_INIT \
    { sizeof(smx_inversion_options), SMX_MASKING_COINCIDES, 1e-10, 1000 }

/** The radial slope density of a BRDF, by power iteration on its retro-reflection, and one Fresnel curve per channel
 * (Dupuy, Heitz, Iehl, Poulin, Ostromoukhov: "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials
 * with Power Iterations", EGSR 2015). Keeps the BRDF alive. Immutable. */
typedef struct smx_density_s *smx_density;

/** Facts about a density. */
typedef struct smx_density_info {
    size_t size;            /**< sizeof(smx_density_info) */
    uint32_t nodes;         /**< of the slope density */
    uint32_t fresnel_knots; /**< theta_d = k pi/180, k = 0..knots-1 */
    uint32_t iterations;    /**< of the inversion */
    int converged;          /**< nonzero: the last one changed less than the tolerance */
    double change;          /**< relative L1 change of the last iteration */
    double alpha;           /**< sqrt of the mean squared slope: the one-lobe fit */
    char sha256[65]; /**< of the table, as smx_brdf_info has it, or of the CSV file; "" for a density from samples */
} smx_density_info;
/** Initialiser of smx_density_info. */
#define SMX_DENSITY_INFO_INIT \
    { sizeof(smx_density_info), 0, 0, 0, 0, 0.0, 0.0, "" }

/** Inverts a table. Cells whose sum of channels is more than 30 times the median of their row in phi_d, and of the rows
 * beside it in theta_h, are taken for faults: the inversion, and fits to the density, see them filled like holes.
 * References and errors are those of the table as it is. Source: Dupuy et al. 2015 (smx_density).
 *
 * @param brdf     the table; the density keeps it alive
 * @param options  how; NULL: the defaults
 * @param density  the new handle
 * @ownership  the caller owns one reference of `*density`
 * @threads    any
 * @statuses   INVALID_ARGUMENT, NO_SOLUTION (no retro-reflection at all), OUT_OF_MEMORY */
SMX_API smx_status smx_density_create(smx_brdf brdf, const smx_inversion_options *options, smx_density *density);

/** What a sampled density is over. */
typedef enum smx_density_kind {
    SMX_DENSITY_P22 = 0, /**< the slope plane */
    SMX_DENSITY_NDF = 1  /**< normals: ndf = p22 / cos^4(theta) */
} smx_density_kind;

/** Most samples that smx_density_from_samples takes. */
#define SMX_MAX_DENSITY_SAMPLES 1048576

/** A density that is from no BRDF. Linear between the samples, level below the first, 0 beyond the last; brought to the
 * inversion's nodes and normalised; F is 1. Such a density takes the shared model only.
 *
 * @param name     shown in reports
 * @param kind     what the values are over
 * @param count    samples, 2..SMX_MAX_DENSITY_SAMPLES
 * @param theta    [count] radians, ascending in 0..pi/2
 * @param values   [count] 0..1e30 in any unit
 * @param density  the new handle
 * @ownership  the caller owns one reference of `*density`; both arrays are copied
 * @threads    any
 * @statuses   INVALID_ARGUMENT, NO_SOLUTION (0 at every node), OUT_OF_MEMORY */
SMX_API smx_status smx_density_from_samples(const char *name, smx_density_kind kind, size_t count, const double *theta,
                                            const double *values, smx_density *density);

/** The same from a CSV file of two columns (docs/density-format.md), named like the file, whose sha256 goes to the
 * materials that are fitted.
 *
 * @param path     of the file, at most 16 MiB
 * @param density  the new handle
 * @ownership  the caller owns one reference of `*density`
 * @threads    any
 * @statuses   INVALID_ARGUMENT, CANNOT_READ, BAD_FORMAT (the message has the line's number), NO_SOLUTION,
 *             OUT_OF_MEMORY */
SMX_API smx_status smx_density_read_csv(const char *path, smx_density *density);

/** Adds a reference.
 *
 * @param density  the handle
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_density_retain(smx_density density);

/** Drops a reference.
 *
 * @param density  the handle, or NULL
 * @threads  any */
SMX_API void smx_density_release(smx_density density);

/** Facts about a density.
 *
 * @param density  the density
 * @param info     written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_density_get_info(smx_density density, smx_density_info *info);

/** The density on its nodes. Any array may be NULL.
 *
 * @param density  the density
 * @param slope    [nodes] >= 0
 * @param p22      [nodes] density over the slope plane
 * @param mass     [nodes] share of the nodes' rings, sums to 1
 * @param nodes    smx_density_info.nodes
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_density_get_nodes(smx_density density, double *slope, double *p22, double *mass, size_t nodes);

#ifdef __cplusplus
}
#endif
#endif
