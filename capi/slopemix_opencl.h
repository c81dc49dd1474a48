/** @file
 * slopemix and OpenCL of the caller's: contexts on a queue that exists, and evaluations on buffers, which return at
 * once.
 *
 * A context on the caller's cl_context and cl_command_queue is made by smx_context_create with both in its options; the
 * queue must be in order. Everything else works on it too.
 *
 * Nothing in this header waits for what it enqueues. It does wait for calls of other threads on the same context, one
 * of which may be rendering; and the first evaluation of a quantity on a context builds its kernel, which takes host
 * time: smx_evaluator_build does it ahead. */
#ifndef SLOPEMIX_OPENCL_H
#define SLOPEMIX_OPENCL_H

#ifndef CL_TARGET_OPENCL_VERSION
/** OpenCL's version that the headers are asked for, unless the program has asked for one. */
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include "slopemix.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Arrays in buffers of the context: x of element k is float x_offset + k * stride of buffer x, and so on. The three
 * may be one buffer. Sizes are checked against the buffers'. Elements that are written may not be elements of another.
 */
typedef struct smx_cl_vectors {
    cl_mem x;        /**< buffer of x */
    cl_mem y;        /**< of y */
    cl_mem z;        /**< of z */
    size_t x_offset; /**< of element 0, in floats */
    size_t y_offset; /**< likewise */
    size_t z_offset; /**< likewise */
    size_t stride;   /**< in floats, at least 1; 3 or 4 of packed ones */
} smx_cl_vectors;

/** The same of one float each. */
typedef struct smx_cl_scalars {
    cl_mem values; /**< the buffer */
    size_t offset; /**< of element 0, in floats */
    size_t stride; /**< in floats, at least 1 */
} smx_cl_scalars;

/** Vectors of one buffer, `stride` floats each, beginning with x, y, z. */
#define SMX_CL_PACKED(buffer, stride) \
    { (buffer), (buffer), (buffer), 0, 1, 2, (stride) }
/** Vectors of one buffer as planes x, y, z of `count` each. */
#define SMX_CL_PLANES(buffer, count) \
    { (buffer), (buffer), (buffer), 0, (count), 2 * (count), 1 }

/** The OpenCL objects that a context works with, of its first device; to make buffers for it.
 *
 * @param context        the context
 * @param cl_context_out, cl_queue_out, cl_device_out  written; any may be NULL
 * @ownership  borrowed, valid while the context lives
 * @threads    any
 * @statuses   INVALID_ARGUMENT */
SMX_API smx_status smx_context_get_opencl(smx_context context, cl_context *cl_context_out,
                                          cl_command_queue *cl_queue_out, cl_device_id *cl_device_out);

/** f cos_i, as smx_evaluator_eval, on buffers.
 *
 * @param evaluator    the evaluator; it may be released at once
 * @param count        pairs of directions, at most what the buffers hold; 0 is legal
 * @param wi, wo       [count], read
 * @param fcos         [count] r, g, b, written
 * @param wait_count   number of events to wait for
 * @param wait         [wait_count], of the same cl_context; NULL where wait_count is 0
 * @param event        the end of the evaluation, the caller's to release; or NULL
 * @threads   any; calls on one context run one after another
 * @statuses  INVALID_ARGUMENT, KERNEL_BUILD, DEVICE_ERROR, OUT_OF_MEMORY. What fails on the device later is
 *            the event's */
SMX_API smx_status smx_enqueue_eval(smx_evaluator evaluator, size_t count, const smx_cl_vectors *wi,
                                    const smx_cl_vectors *wo, const smx_cl_vectors *fcos, cl_uint wait_count,
                                    const cl_event *wait, cl_event *event);

/** Draws, as smx_evaluator_sample, on buffers; f cos of what was drawn is smx_enqueue_eval's.
 *
 * @param evaluator    the evaluator; it may be released at once
 * @param count        draws; 0 is legal
 * @param u, wo        [count], read
 * @param wi           [count], written
 * @param pdf          [count], written
 * @param wait_count, wait, event  as of smx_enqueue_eval
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_enqueue_eval */
SMX_API smx_status smx_enqueue_sample(smx_evaluator evaluator, size_t count, const smx_cl_vectors *u,
                                      const smx_cl_vectors *wo, const smx_cl_vectors *wi, const smx_cl_scalars *pdf,
                                      cl_uint wait_count, const cl_event *wait, cl_event *event);

/** A quantity of a pair of directions, as smx_evaluator_pdf and smx_evaluator_g2, on buffers.
 *
 * @param evaluator    the evaluator; it may be released at once
 * @param quantity     SMX_QUANTITY_PDF or SMX_QUANTITY_G2
 * @param count        pairs of directions; 0 is legal
 * @param wi, wo       [count], read
 * @param values       [count], written
 * @param wait_count, wait, event  as of smx_enqueue_eval
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_enqueue_eval */
SMX_API smx_status smx_enqueue_of_pairs(smx_evaluator evaluator, smx_quantity quantity, size_t count,
                                        const smx_cl_vectors *wi, const smx_cl_vectors *wo,
                                        const smx_cl_scalars *values, cl_uint wait_count, const cl_event *wait,
                                        cl_event *event);

/** A quantity of a direction, as smx_evaluator_ndf, _sigma and _g1, on buffers.
 *
 * @param evaluator    the evaluator; it may be released at once
 * @param quantity     SMX_QUANTITY_NDF, SMX_QUANTITY_SIGMA or SMX_QUANTITY_G1
 * @param count        directions; 0 is legal
 * @param k            [count], read
 * @param values       [count], written
 * @param wait_count, wait, event  as of smx_enqueue_eval
 * @threads   any; calls on one context run one after another
 * @statuses  those of smx_enqueue_eval */
SMX_API smx_status smx_enqueue_of_directions(smx_evaluator evaluator, smx_quantity quantity, size_t count,
                                             const smx_cl_vectors *k, const smx_cl_scalars *values, cl_uint wait_count,
                                             const cl_event *wait, cl_event *event);

#ifdef __cplusplus
}
#endif
#endif
