/* Images. (Part of slopemix.h.) */
#ifndef SLOPEMIX_IMAGE_H
#define SLOPEMIX_IMAGE_H

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct smx_image_s *smx_image;

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
