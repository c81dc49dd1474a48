#include "own_program.h"

#include "check.h"

/* Numbers without gaps: the sequence R3 of Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences". One
 * work-item is no way to add fast, but a short one. */
static const char *const kernels =
    "__kernel void make(float theta_o, __global float *u, __global float *wo) {\n"
    "    uint k = get_global_id(0);\n"
    "    vstore3(convert_float3((k * (uint3)(3518319155u, 2882110345u, 2360945575u)) >> 8) * 0x1p-24f, k, u);\n"
    "    vstore3((float3)(sin(theta_o), 0.0f, cos(theta_o)), k, wo);\n"
    "}\n"
    "__kernel void mean(__global const float *fcos, __global const float *pdf, __global float *albedo) {\n"
    "    float3 sum = 0.0f;\n"
    "    for (int row = 0; row < 512; ++row) {\n"
    "        float3 part = 0.0f;\n"
    "        for (int k = 512 * row; k < 512 * (row + 1); ++k) part += vload3(k, fcos) / pdf[k];\n"
    "        sum += part / 512.0f;\n"
    "    }\n"
    "    vstore3(sum / 512.0f, 0, albedo);\n"
    "}\n";

static cl_kernel kernel_of(const Program *p, cl_program program, const char *name, cl_uint first, const int *buffers) {
    cl_int code;
    cl_kernel kernel = clCreateKernel(program, name, &code);
    CL_OK(code);
    for (cl_uint k = 0; buffers[k] < BUFFERS; ++k)
        CL_OK(clSetKernelArg(kernel, first + k, sizeof(cl_mem), &p->buffers[buffers[k]]));
    return kernel;
}

Program make_program(void) {
    static const int made[] = {U, WO, BUFFERS}, added[] = {FCOS, PDF, ALBEDO, BUFFERS};
    Program p;
    cl_platform_id platform;
    cl_device_id device;
    cl_program program;
    const char *text = kernels;
    cl_int code;
    CL_OK(clGetPlatformIDs(1, &platform, NULL));
    CL_OK(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL));
    p.context = clCreateContext(NULL, 1, &device, NULL, NULL, &code);
    CL_OK(code);
    p.queue = clCreateCommandQueue(p.context, device, 0, &code);
    CL_OK(code);
    for (int k = 0; k < BUFFERS; ++k) {
        p.buffers[k] = clCreateBuffer(p.context, CL_MEM_READ_WRITE, 3 * COUNT * sizeof(float), NULL, &code);
        CL_OK(code);
    }
    program = clCreateProgramWithSource(p.context, 1, &text, NULL, &code);
    CL_OK(code);
    CL_OK(clBuildProgram(program, 1, &device, "", NULL, NULL));
    p.make = kernel_of(&p, program, "make", 1, made);
    p.mean = kernel_of(&p, program, "mean", 0, added);
    clReleaseProgram(program);
    return p;
}

void release_program(Program *p) {
    for (int k = 0; k < BUFFERS; ++k) clReleaseMemObject(p->buffers[k]);
    clReleaseKernel(p->make);
    clReleaseKernel(p->mean);
    clReleaseCommandQueue(p->queue);
    clReleaseContext(p->context);
}
