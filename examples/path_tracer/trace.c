#include "trace.h"

#include <string.h>

#include "check.h"
#include "slopemix_opencl.h"

/* What is needed of a text file; the caller frees it. */
static char *read_text(const char *folder, const char *name) {
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = length > 0 && (size_t)length < sizeof path ? fopen(path, "rb") : NULL;
    char *text = NULL;
    size_t size = 0, got = 0;
    if (!file) {
        fprintf(stderr, "cannot read %s/%s\n", folder, name);
        exit(EXIT_FAILURE);
    }
    do {
        text = realloc(text, size + 4097);
        EXPECT(text != NULL);
        got = fread(text + size, 1, 4096, file);
        size += got;
    } while (got > 0);
    fclose(file);
    text[size] = '\0';
    return text;
}

/* The kernel from three texts: slopemix's device header, which needs no path so, the scene's structs, and the tracer.
 */
static cl_kernel build(cl_context context, cl_device_id device, const char *folder) {
    char *scene = read_text(folder, "scene.h"), *tracer = read_text(folder, "path_tracer.cl");
    const char *texts[] = {smx_device_header(), scene, tracer};
    cl_int code;
    cl_program program = clCreateProgramWithSource(context, 3, texts, NULL, &code);
    cl_kernel kernel;
    CL_OK(code);
    code = clBuildProgram(program, 1, &device, "-cl-std=CL1.2", NULL, NULL);
    if (code != CL_SUCCESS) {
        char log[8192] = "";
        clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof log, log, NULL);
        fprintf(stderr, "%s\n", log);
        CL_OK(code);
    }
    kernel = clCreateKernel(program, "trace", &code);
    CL_OK(code);
    clReleaseProgram(program);
    free(scene);
    free(tracer);
    return kernel;
}

static cl_mem buffer_of(cl_context context, const void *data, size_t size) {
    cl_int code;
    cl_mem buffer = clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, size, (void *)(size_t)data, &code);
    CL_OK(code);
    return buffer;
}

static Settings settings_of(const Studio *studio, const TraceOptions *o) {
    Settings s;
    memset(&s, 0, sizeof s);
    s.camera = studio->camera;
    s.width = o->width, s.height = o->height;
    s.samples = o->samples / PASSES;
    s.seed = o->seed;
    s.by_cosine = o->by_cosine, s.white_sky = o->white_sky, s.bounces = o->bounces;
    s.least_alpha = o->least_alpha;
    s.tile_alpha = studio->tile_alpha;
    s.floor_material = studio->floor_material;
    s.spheres = studio->sphere_count;
    s.lamps = studio->lamp_count;
    return s;
}

/* Adds a pass to the sums of means and of their squares. */
static void add_pass(Estimate *e, const float *rgba) {
    for (int k = 0; k < e->count; ++k) {
        const double value = (double)rgba[k / 3 * 4 + k % 3];
        e->mean[k] += value;
        e->variance[k] += value * value;
    }
}

/* From sums over the passes to their mean and its variance. */
static void finish(Estimate *e) {
    for (int k = 0; k < e->count; ++k) {
        e->mean[k] /= PASSES;
        e->variance[k] = (e->variance[k] / PASSES - e->mean[k] * e->mean[k]) / (PASSES - 1);
    }
}

static Estimate new_estimate(int count) {
    Estimate e = {count, calloc((size_t)count, sizeof(double)), calloc((size_t)count, sizeof(double))};
    EXPECT(e.mean && e.variance);
    return e;
}

void free_estimate(Estimate *estimate) {
    free(estimate->mean);
    free(estimate->variance);
}

void trace(const Studio *studio, const TraceOptions *options, const char *folder, Estimate *estimate) {
    const size_t grid[] = {(size_t)options->width, (size_t)options->height}, size = grid[0] * grid[1] * 4;
    Settings settings = settings_of(studio, options);
    float *rgba = malloc(size * sizeof(float));
    smx_context context;
    cl_context cl;
    cl_command_queue queue;
    cl_device_id device;
    cl_mem buffers[4];
    cl_kernel kernel;
    cl_int code;
    EXPECT(rgba != NULL);
    *estimate = new_estimate(options->width * options->height * 3);

    /* The library's choice of a device serves the example too. */
    OK(smx_context_create(NULL, &context));
    OK(smx_context_get_opencl(context, &cl, &queue, &device));
    kernel = build(cl, device, folder);
    buffers[0] = buffer_of(cl, studio->spheres, sizeof studio->spheres);
    buffers[1] = buffer_of(cl, studio->lamps, sizeof studio->lamps);
    buffers[2] = buffer_of(cl, studio->words, studio->word_count * sizeof(float));
    buffers[3] = clCreateBuffer(cl, CL_MEM_WRITE_ONLY, size * sizeof(float), NULL, &code);
    CL_OK(code);
    for (cl_uint k = 0; k < 4; ++k) CL_OK(clSetKernelArg(kernel, k + 1, sizeof(cl_mem), &buffers[k]));

    for (settings.pass = 0; settings.pass < PASSES; ++settings.pass) {
        CL_OK(clSetKernelArg(kernel, 0, sizeof settings, &settings));
        CL_OK(clEnqueueNDRangeKernel(queue, kernel, 2, NULL, grid, NULL, 0, NULL, NULL));
        CL_OK(clEnqueueReadBuffer(queue, buffers[3], CL_TRUE, 0, size * sizeof(float), rgba, 0, NULL, NULL));
        add_pass(estimate, rgba);
    }
    finish(estimate);
    for (int k = 0; k < 4; ++k) clReleaseMemObject(buffers[k]);
    clReleaseKernel(kernel);
    smx_context_release(context);
    free(rgba);
}
