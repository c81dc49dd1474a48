/** @file
 * slopemix: how a measured material looks on a surface that is rough below the pixel. This header includes those of
 * slopemix/, and these are the conventions of them all.
 *
 * - **Directions**: unit vectors that point away from the surface; wi to the light, wo to the viewer; frame x, y, z
 *   with z the macro-surface normal, x along elevation (e_theta), y along azimuth (e_phi).
 * - **Slopes** of a facet with normal m: (-m.x / m.z, -m.y / m.z).
 * - **Roughness**: alpha = sqrt(2) times the standard deviation of the slope. Variances add; alphas do not.
 * - **Radiometry**: linear RGB; f in 1/sr; "fcos" means f times the cosine of wi; a pixel is the radiance towards the
 *   viewer under a light of unit perpendicular irradiance (a white Lambertian facing it shows 1/pi).
 * - **Angles**: radians.
 * - **Images**: row 0 at the top, left to right, RGBA float32; alpha is 1 on the surface and 0 off it.
 * - **Arrays**: [a][b] has b values in a row; packed, unless a stride is given.
 *
 * @par Handles
 * are reference counted: smx_*_create gives one reference, smx_*_retain adds one, smx_*_release drops one (NULL is
 * legal). A child keeps its parents alive, so any order of release is legal. A function that gets a handle which was
 * released says so, SMX_INVALID_ARGUMENT: surely for the last 256 released, while no new handle has their address.
 *
 * @par Errors
 * A function that can fail returns smx_status: SMX_OK, or one that its comment lists, there without SMX_. When it
 * fails, its outputs are untouched unless it says otherwise, and smx_last_error() says, for the calling thread, what
 * was wrong, with the value and the legal range. The library never prints or exits; what an OpenCL implementation does
 * is its own (docs/robustness.md).
 *
 * @par Threads
 * Any function may be called from any thread. Immutable handles (brdf, density, material, evaluator) may be shared
 * freely; calls that use one context run one after another; an image may be read by many threads or changed by one.
 *
 * @par Options
 * are structs that start with their own size: initialise with the macro of the same name in capitals
 * (`smx_scene s = SMX_SCENE_INIT;`), change fields, pass the address. NULL in place of options means the defaults. The
 * size must be that of this version's struct; a later version that adds fields takes this one's too.
 */
#ifndef SLOPEMIX_H
#define SLOPEMIX_H

#include "slopemix_version.h"

#include "slopemix/brdf.h"
#include "slopemix/brdf_errors.h"
#include "slopemix/choose.h"
#include "slopemix/context.h"
#include "slopemix/density.h"
#include "slopemix/effects.h"
#include "slopemix/eval.h"
#include "slopemix/evaluator.h"
#include "slopemix/geometric.h"
#include "slopemix/image.h"
#include "slopemix/material.h"
#include "slopemix/render.h"
#include "slopemix/scene.h"
#include "slopemix/status.h"

#endif
