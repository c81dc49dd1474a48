#include "exr_header.h"

#include <OpenEXR/openexr.h>

#include "error.h"
#include "scene.h"

namespace smx {

namespace {

// Called from C: keeps the first message, and lets nothing out.
void keep_message(exr_const_context_t context, exr_result_t, const char *message) noexcept {
    void *kept = nullptr;
    if (exr_get_user_data(context, &kept) != EXR_ERR_SUCCESS || !kept) return;
    try {
        std::string &first = *static_cast<std::string *>(kept);
        if (first.empty()) first = message;
    } catch (...) { // the code alone must do
    }
}

} // namespace

void expect_sound_exr_header(const std::string &path) {
    std::string message;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = keep_message;
    settings.user_data = &message;
    settings.max_image_width = settings.max_image_height = static_cast<int>(max_side);
    exr_context_t context = nullptr;
    const exr_result_t result = exr_start_read(&context, path.c_str(), &settings);
    exr_finish(&context);
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    // The core passes over an attribute that it complains of; the reader in C++ would not.
    if (result != EXR_ERR_SUCCESS || !message.empty())
        fail(Fault::BadFormat, path,
             ": not a readable EXR file: ", message.empty() ? exr_get_default_error_message(result) : message.c_str());
}

} // namespace smx
