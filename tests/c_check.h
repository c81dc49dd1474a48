/* Checks for the tests in C: a failed one prints where and what, and the run goes on to show the others. */
#ifndef C_CHECK_H
#define C_CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "slopemix.h"

static int c_check_failures = 0;
static int c_check_count = 0;

static void c_check(int good, const char *file, int line, const char *what) {
    ++c_check_count;
    if (good) return;
    ++c_check_failures;
    fprintf(stderr, "%s:%d: failed: %s\n  last error: \"%s\"\n", file, line, what, smx_last_error());
}

static void c_check_status(smx_status got, smx_status wanted, const char *needle, const char *file, int line,
                           const char *what) {
    ++c_check_count;
    if (got == wanted && (wanted == SMX_OK || (smx_last_error()[0] != '\0' && strstr(smx_last_error(), needle))))
        return;
    ++c_check_failures;
    fprintf(stderr, "%s:%d: %s\n  gave %s, \"%s\"\n  wanted %s with a message that has \"%s\"\n", file, line, what,
            smx_status_name(got), smx_last_error(), smx_status_name(wanted), needle);
}

/* A condition; a call that must succeed; a call that must fail with a status and a message that has `needle`. */
#define CHECK(condition) c_check(!!(condition), __FILE__, __LINE__, #condition)
#define OK(call) c_check_status(call, SMX_OK, "", __FILE__, __LINE__, #call)
#define FAILS(status, needle, call) c_check_status(call, status, needle, __FILE__, __LINE__, #call)
#define INVALID(needle, call) FAILS(SMX_INVALID_ARGUMENT, needle, call)

/* Something that no function may write over when it fails: a handle that is no handle. */
#define UNTOUCHED ((void *)&c_check_count)

/* Sizes that a struct's size field must not have. */
#define WRONG_SIZES(type) \
    { 0, 1, sizeof(type) - 1, sizeof(type) + 8, (size_t)-1 }

static int c_check_result(void) {
    printf("%d checks, %d failed\n", c_check_count, c_check_failures);
    return c_check_failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
