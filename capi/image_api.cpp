// smx_image_*
#include <algorithm>

#include "handles.h"

using namespace smx;

namespace {

smx_image new_handle(Image image) { return new smx_image_s(std::make_shared<Image>(std::move(image))); }

} // namespace

extern "C" {

smx_status smx_image_create(uint32_t width, uint32_t height, const float *rgba, smx_image *image) {
    return guarded([&] {
        require_pointer(image, "image");
        Image made(width, height);
        if (rgba) std::copy(rgba, rgba + made.rgba.size(), made.rgba.begin());
        *image = new_handle(std::move(made));
    });
}

smx_status smx_image_retain(smx_image image) { return retain(image, "image"); }
void smx_image_release(smx_image image) { release(image); }

smx_status smx_image_get_size(smx_image image, uint32_t *width, uint32_t *height) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(width, "width");
        require_pointer(height, "height");
        *width = image->object->width;
        *height = image->object->height;
    });
}

const float *smx_image_pixels(smx_image image) { return is_live_handle(image) ? image->object->rgba.data() : nullptr; }

const float *smx_image_errors(smx_image image) {
    return is_live_handle(image) && !image->object->errors.empty() ? image->object->errors.data() : nullptr;
}

smx_status smx_image_set_attribute(smx_image image, const char *key, const char *value) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(key, "key");
        require_pointer(value, "value");
        validate_attribute_key(key);
        image->object->attributes[key] = value;
    });
}

const char *smx_image_get_attribute(smx_image image, const char *key) {
    if (!is_live_handle(image) || !key) return nullptr;
    const auto &attributes = image->object->attributes;
    const auto found =
        std::find_if(attributes.begin(), attributes.end(), [&](const auto &a) { return a.first == key; });
    return found == attributes.end() ? nullptr : found->second.c_str();
}

smx_status smx_image_read_exr(const char *path, smx_image *image) {
    return guarded([&] {
        require_pointer(path, "path");
        require_pointer(image, "image");
        *image = new_handle(read_exr(path));
    });
}

smx_status smx_image_write_exr(smx_image image, const char *path) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(path, "path");
        write_exr(*image->object, path);
    });
}

smx_status smx_image_display(smx_image image, double exposure, uint8_t *rgb, size_t count) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(rgb, "rgb");
        const std::vector<std::uint8_t> pixels = display_pixels(*image->object, exposure);
        require(count == pixels.size(), "count is ", count, "; the image has ", pixels.size(), " display values");
        std::copy(pixels.begin(), pixels.end(), rgb);
    });
}

smx_status smx_image_write_png(smx_image image, const char *path, double exposure) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(path, "path");
        write_png(*image->object, path, exposure);
    });
}

smx_status smx_image_quantile(smx_image image, double q, double *value) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(value, "value");
        *value = quantile(*image->object, q);
    });
}

smx_status smx_image_compare(smx_image image, smx_image reference, smx_comparison *comparison) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(reference, "reference");
        check_output(comparison, "comparison");
        const Comparison c = compare(*image->object, *reference->object);
        *comparison = {sizeof *comparison, c.relrmse, c.rmse, c.max_error, c.bias, c.pixels};
    });
}
}
