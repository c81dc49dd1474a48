// Where everything on a contact sheet goes, in units that are one or two pixels large, so that text keeps up with the
// pictures.
#pragma once

#include <cstddef>
#include <vector>

#include "contact_sheet.h"

namespace slopemix::cli {

struct Point {
    double x, y;
};

struct Size {
    double width, height;
};

class ContactLayout {
  public:
    static constexpr double margin = 36.0;
    static constexpr double title_height = 84.0;
    static constexpr double note_height = 19.0;

    explicit ContactLayout(const ContactSheet &sheet);

    Size page() const { return page_; }
    double pixels_per_unit() const { return pixels_per_unit_; }
    Size cell() const { return cell_; }
    std::size_t columns() const { return columns_.size(); }
    double column(std::size_t k) const { return columns_[k]; } // its left end
    double column_centre(std::size_t k) const { return columns_[k] + column_width() / 2.0; }
    double column_end(std::size_t k) const { return columns_[k] + column_width(); }
    double headings() const { return margin + title_height; } // upper ends from here on
    double table(std::size_t t) const { return tables_[t]; }
    double row(std::size_t t, std::size_t r) const;
    double notes() const { return notes_; } // baseline of the first

  private:
    double column_width() const;
    double row_height() const;

    double pixels_per_unit_ = 1.0;
    Size cell_;
    std::vector<double> columns_, tables_;
    double notes_ = 0.0;
    Size page_ = {};
};

} // namespace slopemix::cli
