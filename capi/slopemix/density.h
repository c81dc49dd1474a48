/* Slope densities: a measured BRDF inverted, or samples. (Part of slopemix.h.) */
#ifndef SLOPEMIX_DENSITY_H
#define SLOPEMIX_DENSITY_H

#include "brdf.h"

#ifdef __cplusplus
extern "C" {
#endif

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

#ifdef __cplusplus
}
#endif
#endif
