/* smx_device_* and smx_context_* with every bad argument. */
#include "c_objects.h"

static void check_devices(void) {
    const size_t sizes[] = WRONG_SIZES(smx_device_info);
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    uint32_t count = 0;
    size_t k;
    INVALID("count", smx_device_count(NULL));
    OK(smx_device_count(&count));
    INVALID("info", smx_device_get_info(0, NULL));
    for (k = 0; k < 5; ++k) {
        info.size = sizes[k];
        INVALID("size", smx_device_get_info(0, &info));
    }
    info.size = sizeof info;
    FAILS(SMX_NO_DEVICE, "4294967295", smx_device_get_info(UINT32_MAX, &info));
    CHECK(info.name[0] == '\0');
}

static void check_create(void) {
    static const uint32_t bad_widths[] = {2, 3, 5, 17, 32, UINT32_MAX};
    const size_t sizes[] = WRONG_SIZES(smx_context_options);
    const smx_context_options good = SMX_CONTEXT_OPTIONS_INIT;
    smx_context_options bad = good;
    smx_context context = (smx_context)UNTOUCHED;
    size_t k;
    INVALID("context", smx_context_create(NULL, NULL));
    for (k = 0; k < 5; ++k) {
        bad.size = sizes[k];
        INVALID("size", smx_context_create(&bad, &context));
    }
    for (k = 0; k < sizeof bad_widths / sizeof *bad_widths; ++k) {
        bad = good;
        bad.vector_width = bad_widths[k];
        INVALID("vector_width", smx_context_create(&bad, &context));
    }
    bad = good;
    bad.cl_context = UNTOUCHED;
    INVALID("cl_queue", smx_context_create(&bad, &context));
    bad = good;
    bad.device = "no such device anywhere";
    FAILS(SMX_NO_DEVICE, "no such device anywhere", smx_context_create(&bad, &context));
    CHECK(context == (smx_context)UNTOUCHED);
}

static void check_info(void) {
    const size_t sizes[] = WRONG_SIZES(smx_device_info);
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    smx_context context = NULL;
    size_t k;
    OK(smx_context_create(NULL, &context));
    INVALID("context", smx_context_get_info(NULL, &info));
    INVALID("info", smx_context_get_info(context, NULL));
    for (k = 0; k < 5; ++k) {
        info.size = sizes[k];
        INVALID("size", smx_context_get_info(context, &info));
    }
    CHECK(info.name[0] == '\0');
    smx_context_release(context);
}

int main(void) {
    check_devices();
    check_create();
    check_info();
    return c_check_result();
}
