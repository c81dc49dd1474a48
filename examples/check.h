/* Examples end at the first error, and say what the library or OpenCL had to say. */
#ifndef CHECK_H
#define CHECK_H

#include <stdio.h>
#include <stdlib.h>

#include "slopemix.h"

/* A call of the library that must succeed; one of OpenCL; and what an example knows of its own result. */
#define OK(call) ok_or_exit(call, #call)
#define CL_OK(code) cl_ok_or_exit(code, __FILE__, __LINE__)
#define EXPECT(condition) expect_or_exit(condition, #condition)

static inline void ok_or_exit(smx_status status, const char *call) {
    if (status == SMX_OK) return;
    fprintf(stderr, "%s\n    gave %s: %s\n", call, smx_status_name(status), smx_last_error());
    exit(EXIT_FAILURE);
}

static inline void cl_ok_or_exit(int code, const char *file, int line) {
    if (code == 0) return;
    fprintf(stderr, "%s:%d: OpenCL gave %d\n", file, line, code);
    exit(EXIT_FAILURE);
}

static inline void expect_or_exit(int good, const char *condition) {
    if (good) return;
    fprintf(stderr, "the result is wrong: expected %s\n", condition);
    exit(EXIT_FAILURE);
}

#endif
