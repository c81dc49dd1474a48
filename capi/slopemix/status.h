/** @file
 * Statuses, messages, the version, and progress. (Part of slopemix.h.) */
#ifndef SLOPEMIX_STATUS_H
#define SLOPEMIX_STATUS_H

#include <stddef.h>
#include <stdint.h>

/** Marks the functions that the library exports. */
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

/** What a function that can fail returns. */
typedef enum smx_status {
    SMX_OK = 0,               /**< done */
    SMX_INVALID_ARGUMENT = 1, /**< a null pointer, a wrong size field, a value out of its range */
    SMX_CANNOT_READ = 2,      /**< a file is missing or unreadable */
    SMX_CANNOT_WRITE = 3,     /**< an output cannot be made; what was there before is still there */
    SMX_BAD_FORMAT = 4,       /**< a file's content is not what its format demands */
    SMX_NO_DEVICE = 5,        /**< no OpenCL device, or none that matches */
    SMX_KERNEL_BUILD = 6,     /**< the device's compiler refused a kernel; its log is in the message */
    SMX_DEVICE_ERROR = 7,     /**< an OpenCL call failed */
    SMX_OUT_OF_MEMORY = 8,    /**< host or device memory */
    SMX_NO_SOLUTION = 9,      /**< the data have no answer: a table of zeros, a fit that cannot start */
    SMX_CANCELLED = 10,       /**< a progress callback asked to stop */
    SMX_INTERNAL = 11         /**< a fault of the library itself; any function may return it */
} smx_status;

/** Name of a status, "SMX_BAD_FORMAT".
 *
 * @param status  any number
 * @return        the name; "unknown status" for a value that is none
 * @ownership     the library's, valid for ever
 * @threads       any */
SMX_API const char *smx_status_name(smx_status status);

/** Sentence of a status.
 *
 * @param status  any number
 * @return        the sentence; "unknown status" for a value that is none
 * @ownership     the library's, valid for ever
 * @threads       any */
SMX_API const char *smx_status_text(smx_status status);

/** What the last failing call of this thread had to say: what was wrong, with the value and the legal range.
 *
 * @return     the message; "" if none failed
 * @ownership  the library's, valid until the thread's next call
 * @threads    any; each has its own */
SMX_API const char *smx_last_error(void);

/** Version of the library in use; SMX_VERSION_STRING is the header's.
 *
 * @return     "MAJOR.MINOR.PATCH"
 * @ownership  the library's, valid for ever
 * @threads    any */
SMX_API const char *smx_version(void);

/** A callback of the caller's, called now and then from the thread that made the call. It starts again from 0 where a
 * target_error needs more samples. It may not render or evaluate on the same context: such a call returns
 * SMX_INVALID_ARGUMENT.
 *
 * @param user   what stands in smx_render_options.progress_user
 * @param share  the share done, 0..1
 * @return       nonzero stops the work, and the call returns SMX_CANCELLED */
typedef int (*smx_progress_fn)(void *user, double share);

#ifdef __cplusplus
}
#endif
#endif
