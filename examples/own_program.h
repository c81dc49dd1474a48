/* A program that knows nothing of slopemix: a context, a queue, buffers, and two kernels. */
#ifndef OWN_PROGRAM_H
#define OWN_PROGRAM_H

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

enum { COUNT = 512 * 512 };

/* Of floats: three numbers for each element; PDF one, and ALBEDO three in all. */
enum { U, WO, WI, FCOS, PDF, ALBEDO, BUFFERS };

typedef struct {
    cl_context context;
    cl_command_queue queue;
    cl_kernel make; /* of an angle theta_o: COUNT elements of U, uniform numbers, and of WO, one direction */
    cl_kernel mean; /* ALBEDO, the mean of FCOS / PDF; a single work-item */
    cl_mem buffers[BUFFERS];
} Program;

Program make_program(void);
void release_program(Program *program);

#endif
