// Drawing with cairo: an image surface and its toy text interface.
#include "contact_pen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "handles.h"
#include "text.h"

namespace slopemix::cli {

namespace {

constexpr double largest_side = 30000.0; // cairo's images end at 32767
constexpr double subscript_size = 0.72;  // of the font's
constexpr double subscript_drop = 0.2;

void require_success(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw CommandError(std::string("cannot draw the contact sheet: ") + cairo_status_to_string(status));
}

void set_colour(cairo_t *canvas, Colour colour) { cairo_set_source_rgb(canvas, colour.red, colour.green, colour.blue); }

} // namespace

Pen::Pen(Size page, double pixels_per_unit) {
    const double scale = std::min(pixels_per_unit, largest_side / std::max(page.width, page.height));
    surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(scale * page.width)),
                                              static_cast<int>(std::ceil(scale * page.height))));
    canvas_.reset(cairo_create(surface_.get()));
    require_success(cairo_status(canvas_.get()));
    set_colour(canvas_.get(), {1.0, 1.0, 1.0});
    cairo_paint(canvas_.get());
    cairo_scale(canvas_.get(), scale, scale);
}

void Pen::font(double size, Colour colour, bool bold) {
    cairo_select_font_face(canvas_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(canvas_.get(), size);
    font_size_ = size;
    set_colour(canvas_.get(), colour);
}

double Pen::advance(const std::string &words) {
    cairo_text_extents_t extents;
    cairo_text_extents(canvas_.get(), words.c_str(), &extents);
    return extents.x_advance;
}

void Pen::text(Point at, double anchor, const std::string &words, double room) {
    const std::string utf8 = to_utf8(words);
    const double width = advance(utf8);
    const double shrink = width > room ? room / width : 1.0;
    cairo_set_font_size(canvas_.get(), shrink * font_size_);
    cairo_move_to(canvas_.get(), std::round(at.x - anchor * shrink * width), at.y);
    cairo_show_text(canvas_.get(), utf8.c_str());
    cairo_set_font_size(canvas_.get(), font_size_);
}

void Pen::formula(Point at, const std::string &words) {
    cairo_move_to(canvas_.get(), at.x, at.y);
    for (std::size_t begin = 0; begin < words.size();) {
        const std::size_t mark = std::min(words.find('_', begin), words.size());
        cairo_show_text(canvas_.get(), words.substr(begin, mark - begin).c_str());
        if (mark == words.size()) return;
        cairo_set_font_size(canvas_.get(), subscript_size * font_size_);
        cairo_rel_move_to(canvas_.get(), 0.0, subscript_drop * font_size_);
        cairo_show_text(canvas_.get(), words.substr(mark + 1, 1).c_str());
        cairo_rel_move_to(canvas_.get(), 0.0, -subscript_drop * font_size_);
        cairo_set_font_size(canvas_.get(), font_size_);
        begin = mark + 2;
    }
}

void Pen::box(Point corner, Size size, Colour colour) {
    set_colour(canvas_.get(), colour);
    cairo_rectangle(canvas_.get(), corner.x, corner.y, size.width, size.height);
    cairo_fill(canvas_.get());
}

Pen::Surface Pen::to_surface(const Picture &picture) {
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    require_success(cairo_surface_status(surface.get()));
    unsigned char *row = cairo_image_surface_get_data(surface.get());
    const std::uint8_t *rgb = picture.rgb.data();
    for (int y = 0; y < height; ++y, row += cairo_image_surface_get_stride(surface.get()))
        for (int x = 0; x < width; ++x, rgb += 3) {
            const std::uint32_t pixel = std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2];
            std::memcpy(row + std::ptrdiff_t{4} * x, &pixel, sizeof pixel);
        }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

void Pen::picture(Point corner, Size size, const Picture &picture) {
    const Surface surface = to_surface(picture);
    double pixels = size.width, unused = 0.0;
    cairo_user_to_device_distance(canvas_.get(), &pixels, &unused);
    const bool shrinks = pixels + 0.5 < picture.width;
    cairo_save(canvas_.get());
    cairo_user_to_device(canvas_.get(), &corner.x, &corner.y);
    corner = {std::round(corner.x), std::round(corner.y)};
    cairo_device_to_user(canvas_.get(), &corner.x, &corner.y);
    cairo_translate(canvas_.get(), corner.x, corner.y);
    cairo_rectangle(canvas_.get(), 0.0, 0.0, size.width, size.height);
    cairo_clip(canvas_.get());
    cairo_scale(canvas_.get(), size.width / picture.width, size.height / picture.height);
    cairo_set_source_surface(canvas_.get(), surface.get(), 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(canvas_.get()), shrinks ? CAIRO_FILTER_BEST : CAIRO_FILTER_NEAREST);
    cairo_pattern_set_extend(cairo_get_source(canvas_.get()), CAIRO_EXTEND_PAD);
    cairo_paint(canvas_.get());
    cairo_restore(canvas_.get());
}

void Pen::write_png(const std::filesystem::path &file) const {
    require_success(cairo_status(canvas_.get()));
    const cairo_status_t written = cairo_surface_write_to_png(surface_.get(), file.c_str());
    if (written != CAIRO_STATUS_SUCCESS)
        throw CommandError("cannot write the contact sheet " + file.string() + ": " + cairo_status_to_string(written));
}

} // namespace slopemix::cli
