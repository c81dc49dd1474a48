/* Statuses, messages, the version, and progress. (Part of slopemix.h.) */
#ifndef SLOPEMIX_STATUS_H
#define SLOPEMIX_STATUS_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define SMX_API __declspec(dllimport)
#elif defined(SMX_BUILDING_LIBRARY)
#define SMX_API __attribute__((visibility("default")))
#else
#define SMX_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum smx_status {
    SMX_OK = 0,
    SMX_INVALID_ARGUMENT = 1, /* a null pointer, a wrong size field, a value out of its range */
    SMX_CANNOT_READ = 2,      /* a file is missing or unreadable */
    SMX_CANNOT_WRITE = 3,     /* an output cannot be made; what was there before is still there */
    SMX_BAD_FORMAT = 4,       /* a file's content is not what its format demands */
    SMX_NO_DEVICE = 5,        /* no OpenCL device, or none that matches */
    SMX_KERNEL_BUILD = 6,     /* the device's compiler refused a kernel; its log is in the message */
    SMX_DEVICE_ERROR = 7,     /* an OpenCL call failed */
    SMX_OUT_OF_MEMORY = 8,    /* host or device memory */
    SMX_NO_SOLUTION = 9,      /* the data have no answer: a table of zeros, a fit that cannot start */
    SMX_CANCELLED = 10,       /* a progress callback asked to stop */
    SMX_INTERNAL = 11         /* a fault of the library itself */
} smx_status;

/* Name ("SMX_BAD_FORMAT") and sentence of a status; "unknown status" for a value that is none. Static strings. */
SMX_API const char *smx_status_name(smx_status status);
SMX_API const char *smx_status_text(smx_status status);

/* What the last failing call of this thread had to say; "" if none failed. Valid until the thread's next call. */
SMX_API const char *smx_last_error(void);

/* Version of the library in use, "MAJOR.MINOR.PATCH"; SMX_VERSION_STRING is the header's. */
SMX_API const char *smx_version(void);

/* Called now and then with the share done, 0..1, from the thread that made the call; nonzero stops the work, and the
 * call returns SMX_CANCELLED. It starts again from 0 where a target_error needs more samples. The callback may not
 * render or evaluate on the same context: such a call returns SMX_INVALID_ARGUMENT. */
typedef int (*smx_progress_fn)(void *user, double share);

#ifdef __cplusplus
}
#endif
#endif
