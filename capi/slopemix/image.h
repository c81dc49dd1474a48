/** @file
 * Images. (Part of slopemix.h.) */
#ifndef SLOPEMIX_IMAGE_H
#define SLOPEMIX_IMAGE_H

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** An image: RGBA float32, row 0 at the top. It may be read by many threads or changed by one. */
typedef struct smx_image_s *smx_image;

/** Makes an image.
 *
 * @param width, height  1..16384
 * @param rgba           [height][width][4], linear, or NULL for a black image with alpha 0
 * @param image          the new handle
 * @ownership  the caller owns one reference of `*image`; the pixels are copied
 * @threads    any
 * @statuses   INVALID_ARGUMENT, OUT_OF_MEMORY */
SMX_API smx_status smx_image_create(uint32_t width, uint32_t height, const float *rgba, smx_image *image);

/** Adds a reference.
 *
 * @param image  the handle
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_image_retain(smx_image image);

/** Drops a reference.
 *
 * @param image  the handle, or NULL
 * @threads  any */
SMX_API void smx_image_release(smx_image image);

/** Sides of an image.
 *
 * @param image          the image
 * @param width, height  written, in pixels
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_image_get_size(smx_image image, uint32_t *width, uint32_t *height);

/** The pixels.
 *
 * @param image  the image
 * @return       [height][width][4]; NULL for a null image
 * @ownership    the image's, valid while it lives
 * @threads      any */
SMX_API const float *smx_image_pixels(smx_image image);

/** Standard errors of a reference that was rendered with options.errors, or read from such a file. They are those of a
 * mean of eight scrambles, or of a geometric reference's realisations: an interval is Student's, of 7 degrees of
 * freedom, or of one less than the realisations. Of 2000 trials with 4096 samples, intervals of 95 % of the statistical
 * reference held the converged value in 94.6 % (sobol) and 92.9 % (mis; 94 % of 7000 others, of surfaces with two
 * axes): means are a little skewed (tests/test_coverage.cpp).
 *
 * @param image  the image
 * @return       [height][width][4]: of R, G and B, and the pixel's alpha; NULL where there are none
 * @ownership    the image's, valid while it lives
 * @threads      any */
SMX_API const float *smx_image_errors(smx_image image);

/** Sets a header attribute, which is written to EXR and read back. A rendered image carries its configuration under
 * "slopemix.*".
 *
 * @param image  the image, changed
 * @param key    1..255 characters, not one of EXR's own names
 * @param value  the text, copied
 * @threads   one at a time on one image
 * @statuses  INVALID_ARGUMENT, OUT_OF_MEMORY */
SMX_API smx_status smx_image_set_attribute(smx_image image, const char *key, const char *value);

/** A header attribute.
 *
 * @param image  the image
 * @param key    its name
 * @return       the text; NULL if there is none of that name
 * @ownership    the image's, valid until an attribute of the image is set
 * @threads      any */
SMX_API const char *smx_image_get_attribute(smx_image image, const char *key);

/** Reads any EXR that has R, G and B: alpha is 1 where there is no A; standard errors where error.R, error.G and
 * error.B are all there.
 *
 * @param path   of the file
 * @param image  the new handle
 * @ownership  the caller owns one reference of `*image`
 * @threads    any
 * @statuses   INVALID_ARGUMENT, CANNOT_READ, BAD_FORMAT, OUT_OF_MEMORY */
SMX_API smx_status smx_image_read_exr(const char *path, smx_image *image);

/** Writes EXR: channels R, G, B, A as float32, scan lines, linear; error.R, error.G, error.B too for an image with
 * standard errors. Atomic.
 *
 * @param image  the image
 * @param path   of the file
 * @threads   any
 * @statuses  INVALID_ARGUMENT, CANNOT_WRITE, OUT_OF_MEMORY */
SMX_API smx_status smx_image_write_exr(smx_image image, const char *path);

/** 8-bit display pixels: sRGB transfer of clip(exposure * linear) over the blue background.
 *
 * @param image     the image
 * @param exposure  > 0
 * @param rgb       [height][width][3]
 * @param count     number of bytes of `rgb`, which must be 3 * width * height
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_image_display(smx_image image, double exposure, uint8_t *rgb, size_t count);

/** The same as a PNG file. Atomic.
 *
 * @param image     the image
 * @param path      of the file
 * @param exposure  > 0
 * @threads   any
 * @statuses  INVALID_ARGUMENT, CANNOT_WRITE */
SMX_API smx_status smx_image_write_png(smx_image image, const char *path, double exposure);

/** A quantile of the R, G, B values of pixels with alpha > 0, NaNs left out.
 *
 * @param image  the image
 * @param q      0..1
 * @param value  the q-quantile; 0 if there are no values
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_image_quantile(smx_image image, double q, double *value);

/** Errors of an image a against a reference b. */
typedef struct smx_comparison {
    size_t size; /**< sizeof(smx_comparison) */
    double
        relrmse; /**< sqrt(mean (a-b)^2) / sqrt(mean b^2); infinity where b is black and a is not, 0 where both are */
    double rmse; /**< sqrt(mean (a-b)^2) */
    double max_error; /**< largest |a-b| */
    double bias;      /**< mean a / mean b; 1 where both are black, infinity where only b is */
    uint64_t pixels;  /**< compared: those with alpha > 0 in b */
} smx_comparison;
/** Initialiser of smx_comparison. */
#define SMX_COMPARISON_INIT \
    { sizeof(smx_comparison), 0.0, 0.0, 0.0, 0.0, 0 }

/** Errors of an image over the pixels with alpha > 0 in the reference and the three channels.
 *
 * @param image       the image
 * @param reference   what it is compared with
 * @param comparison  written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT (also images of different size, or no pixel to compare) */
SMX_API smx_status smx_image_compare(smx_image image, smx_image reference, smx_comparison *comparison);

#ifdef __cplusplus
}
#endif
#endif
