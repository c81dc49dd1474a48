// Text, boxes and pictures on a cairo canvas, with cairo's errors as exceptions.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "contact_layout.h"
#include "contact_sheet.h"

namespace slopemix::cli {

struct Colour {
    double red, green, blue;
};

class Pen {
  public:
    static constexpr double unlimited = std::numeric_limits<double>::infinity();

    // A page of this size in units, drawn smaller than asked for if it is larger than an image can be.
    Pen(Size page, double pixels_per_unit);

    void font(double size, Colour colour, bool bold = false);

    // `at` is on the baseline; `anchor` is the share of the text's width to the left of it. Text that is wider than
    // `room` is set smaller.
    void text(Point at, double anchor, const std::string &words, double room = unlimited);

    // Text from `at` on, in which an underscore makes the character after it a subscript.
    void formula(Point at, const std::string &words);

    void box(Point corner, Size size, Colour colour);
    void picture(Point corner, Size size, const Picture &picture);

    void write_png(const std::filesystem::path &file) const;

  private:
    template <auto destroy>
    struct Destroy {
        void operator()(auto *object) const noexcept { destroy(object); }
    };
    using Surface = std::unique_ptr<cairo_surface_t, Destroy<cairo_surface_destroy>>;
    using Canvas = std::unique_ptr<cairo_t, Destroy<cairo_destroy>>;

    static Surface to_surface(const Picture &picture);
    double advance(const std::string &words);

    Surface surface_;
    Canvas canvas_;
    double font_size_ = 12.0;
};

} // namespace slopemix::cli
