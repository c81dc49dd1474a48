// Columns from left to right, tables from top to bottom.
#include "contact_layout.h"

#include <algorithm>
#include <cmath>

namespace slopemix::cli {

namespace {

constexpr double row_label_width = 72.0;
constexpr double narrowest_column = 84.0; // headings need their room
constexpr double column_gap = 6.0;
constexpr double group_gap = 24.0;
constexpr double headings_height = 56.0;
constexpr double table_heading_height = 40.0;
constexpr double table_gap = 12.0;
constexpr double caption_height = 22.0;
constexpr double row_gap = 4.0;

double longer_side(const Resolution &resolution) { return std::max(resolution.width, resolution.height); }

// In pixels. Pictures keep theirs between 96 and 256 on the longer side; small ones grow by a whole factor.
Size picture_size(const Resolution &resolution) {
    const double longer = longer_side(resolution);
    const double scale = longer > 256.0 ? 256.0 / longer : longer < 96.0 ? std::ceil(96.0 / longer) : 1.0;
    return {std::max(1.0, std::round(scale * resolution.width)), std::max(1.0, std::round(scale * resolution.height))};
}

} // namespace

ContactLayout::ContactLayout(const ContactSheet &sheet)
    : pixels_per_unit_(longer_side(sheet.resolution) < 192.0 ? 1.0 : 2.0) {
    const auto [picture_width, picture_height] = picture_size(sheet.resolution);
    cell_ = {picture_width / pixels_per_unit_, picture_height / pixels_per_unit_};

    double x = margin + row_label_width;
    for (const ContactSheet::Group &group : sheet.groups) {
        for (std::size_t k = 0; k < group.columns.size(); ++k, x += column_width() + column_gap) columns_.push_back(x);
        x += group_gap - column_gap;
    }

    double y = headings() + headings_height;
    for (const ContactSheet::Table &table : sheet.tables) {
        tables_.push_back(y);
        y += table_heading_height + static_cast<double>(table.rows.size()) * row_height() + table_gap;
    }
    notes_ = y + note_height;
    page_ = {x - group_gap + margin, notes_ + static_cast<double>(sheet.notes.size()) * note_height + margin / 2.0};
}

double ContactLayout::row(std::size_t t, std::size_t r) const {
    return tables_[t] + table_heading_height + static_cast<double>(r) * row_height();
}

double ContactLayout::column_width() const { return std::max(cell_.width, narrowest_column); }
double ContactLayout::row_height() const { return cell_.height + caption_height + row_gap; }

} // namespace slopemix::cli
