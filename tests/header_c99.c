/* slopemix.h alone, as strict C99: compiling is the test. */
#include "slopemix.h"

smx_status slopemix_header_c99(smx_context *context);

smx_status slopemix_header_c99(smx_context *context) {
    const smx_scene scene = SMX_SCENE_INIT;
    const smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    return scene.size == sizeof scene ? smx_context_create(&options, context) : SMX_INTERNAL;
}
