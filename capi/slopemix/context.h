/** @file
 * OpenCL devices, and contexts on them. (Part of slopemix.h.) */
#ifndef SLOPEMIX_CONTEXT_H
#define SLOPEMIX_CONTEXT_H

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Facts about a device, or about the devices of a context. */
typedef struct smx_device_info {
    size_t size;                /**< sizeof(smx_device_info) */
    uint32_t index;             /**< position over all platforms; what smx_context_options.device takes as a number */
    char name[128];             /**< of the device */
    char vendor[128];           /**< of the device */
    char version[128];          /**< OpenCL version of the device */
    char driver[128];           /**< version of the driver */
    char platform[128];         /**< name of the platform */
    char platform_version[128]; /**< OpenCL version of the platform */
    uint32_t compute_units;     /**< of the device */
    uint64_t global_memory;     /**< bytes */
    uint32_t vector_width;      /**< evaluations per work-item that slopemix uses on it: 1, 4, 8 or 16 */
    double build_seconds; /**< of a context: what compiling kernels has taken so far, on the device that took longest */
    uint32_t devices;     /**< of a context: how many work together; compute_units is their sum, all else the first's */
} smx_device_info;
/** Initialiser of smx_device_info. */
#define SMX_DEVICE_INFO_INIT \
    { sizeof(smx_device_info), 0, "", "", "", "", "", "", 0, 0, 0, 0.0, 0 }

/** Number of OpenCL devices over all platforms.
 *
 * @param count  written; 0 is not an error
 * @threads   any
 * @statuses  INVALID_ARGUMENT (count is null) */
SMX_API smx_status smx_device_count(uint32_t *count);

/** Facts about a device.
 *
 * @param index  0 <= index < count of smx_device_count
 * @param info   written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT, NO_DEVICE (no such index) */
SMX_API smx_status smx_device_get_info(uint32_t index, smx_device_info *info);

/** Where a context works. */
typedef struct smx_context_options {
    size_t size;           /**< sizeof(smx_context_options) */
    const char *device;    /**< NULL: first CPU, else first device; digits: an index; else part of a name, any case;
                                several, separated by commas, work together */
    void *cl_context;      /**< the caller's cl_context, with cl_queue, or NULL; retained; `device` must be NULL */
    void *cl_queue;        /**< the caller's cl_command_queue, in order, with cl_context, or NULL; retained */
    uint32_t vector_width; /**< 0: from the first device; else 1, 4, 8 or 16 evaluations per work-item */
    uint32_t sub_devices;  /**< 0 or 1: devices are whole; else each is cut into as many like sub-devices, at most its
                                compute units; not with cl_context */
    int copy_arrays; /**< nonzero: smx_evaluator_* copy the caller's arrays also where the device shares the host's
                          memory, and could work on them in place */
} smx_context_options;
/** Defaults of smx_context_options. */
#define SMX_CONTEXT_OPTIONS_INIT \
    { sizeof(smx_context_options), NULL, NULL, NULL, 0, 0, 0 }

/** Devices, their queues and the kernels built for them. Kernels are built on first use and kept. Rendering and
 * smx_brdf_integrate take tiles from one queue on all devices, with the same bits on any number of like devices at one
 * vector_width; smx_material_eval, smx_brdf_eval and evaluators run on the first. */
typedef struct smx_context_s *smx_context;

/** Makes a context.
 *
 * @param options  where it works; NULL: the defaults
 * @param context  the new handle
 * @ownership  the caller owns one reference of `*context`; an OpenCL context and queue of the caller's are retained
 * @threads    any
 * @statuses   INVALID_ARGUMENT, NO_DEVICE, DEVICE_ERROR, OUT_OF_MEMORY */
SMX_API smx_status smx_context_create(const smx_context_options *options, smx_context *context);

/** Adds a reference.
 *
 * @param context  the handle
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_context_retain(smx_context context);

/** Drops a reference.
 *
 * @param context  the handle, or NULL
 * @threads  any */
SMX_API void smx_context_release(smx_context context);

/** Facts about a context's devices.
 *
 * @param context  the context
 * @param info     written; its size field must be set
 * @threads   any
 * @statuses  INVALID_ARGUMENT */
SMX_API smx_status smx_context_get_info(smx_context context, smx_device_info *info);

#ifdef __cplusplus
}
#endif
#endif
