/* The path tracer on a device: OpenCL's part of the example. */
#ifndef TRACE_H
#define TRACE_H

#include "studio.h"

/* An image is made in as many passes, whose means are independent: their variance tells the image's error. */
enum { PASSES = 16 };

typedef struct {
    int width, height;
    int samples; /* per pixel, a multiple of PASSES */
    int seed;
    int by_cosine;     /* directions by the cosine, not by the material's lobes */
    int white_sky;     /* radiance 1 from everywhere but the lamps */
    int bounces;       /* surfaces on a path, at most */
    float least_alpha; /* what every surface is roughened by */
} TraceOptions;

typedef struct {
    int count;        /* width * height * 3 */
    double *mean;     /* [height][width][3], linear RGB, row 0 at the top */
    double *variance; /* of the mean */
} Estimate;

/* Traces the studio on the library's default device; or ends the program. `folder` holds path_tracer.cl. */
void trace(const Studio *studio, const TraceOptions *options, const char *folder, Estimate *estimate);
void free_estimate(Estimate *estimate);

#endif
