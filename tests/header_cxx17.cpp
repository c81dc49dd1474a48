// slopemix.h alone, as C++17: compiling is the test.
#include "slopemix.h"

smx_status slopemix_header_cxx17(smx_context *context);

smx_status slopemix_header_cxx17(smx_context *context) {
    const smx_scene scene = SMX_SCENE_INIT;
    const smx_render_options render = SMX_RENDER_OPTIONS_INIT;
    const smx_brdf_info info = SMX_BRDF_INFO_INIT;
    return scene.size + render.size + info.size > 0 ? smx_context_create(nullptr, context) : SMX_INTERNAL;
}
