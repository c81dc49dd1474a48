// Draws a contact sheet: title, column headings, tables, notes.
#include "contact_sheet.h"

#include "contact_layout.h"
#include "contact_pen.h"

namespace slopemix::cli {

namespace {

constexpr Colour blank = {0.93, 0.93, 0.93};
constexpr Colour rule = {0.75, 0.75, 0.75};
constexpr Colour ink = {0.1, 0.1, 0.1};
constexpr Colour soft_ink = {0.4, 0.4, 0.4};

void draw_title(const ContactSheet &sheet, const ContactLayout &layout, Pen &pen) {
    const double room = layout.page().width - 2.0 * ContactLayout::margin;
    pen.font(30.0, ink, true);
    pen.text({ContactLayout::margin, ContactLayout::margin + 26.0}, 0.0, sheet.title, room);
    pen.font(14.0, soft_ink);
    pen.text({ContactLayout::margin, ContactLayout::margin + 54.0}, 0.0, sheet.subtitle, room);
}

void draw_column_headings(const ContactSheet &sheet, const ContactLayout &layout, Pen &pen) {
    const double top = layout.headings();
    std::size_t column = 0;
    for (const ContactSheet::Group &group : sheet.groups) {
        const std::size_t last = column + group.columns.size() - 1;
        const double begin = layout.column(column), end = layout.column_end(last);
        if (!group.heading.empty()) {
            pen.font(15.0, ink);
            pen.text({(begin + end) / 2.0, top + 14.0}, 0.5, group.heading, end - begin);
            pen.box({begin, top + 25.0}, {end - begin, 1.0}, rule);
        }
        pen.font(13.0, soft_ink);
        for (const std::string &heading : group.columns)
            pen.text({layout.column_centre(column++), top + 46.0}, 0.5, heading);
    }
}

void draw_cell(const ContactSheet::Cell &cell, Point corner, Size size, Pen &pen) {
    if (cell.picture)
        pen.picture(corner, size, *cell.picture);
    else
        pen.box(corner, size, blank);
    pen.font(12.0, soft_ink);
    pen.text({corner.x + size.width / 2.0, corner.y + size.height + 15.0}, 0.5, cell.caption);
}

void draw_row(const ContactSheet &sheet, const ContactLayout &layout, std::size_t table, std::size_t row, Pen &pen) {
    const Size size = layout.cell();
    const double top = layout.row(table, row);
    pen.font(14.0, ink);
    pen.text({ContactLayout::margin, top + size.height / 2.0 + 5.0}, 0.0, sheet.tables[table].rows[row]);

    for (std::size_t column = 0; column < layout.columns(); ++column) {
        const ImageId id = {static_cast<std::uint32_t>(table + 1), static_cast<std::uint32_t>(row + 1),
                            static_cast<std::uint32_t>(column + 1)};
        draw_cell(sheet.cell_at(id), {layout.column_centre(column) - size.width / 2.0, top}, size, pen);
    }
}

void draw_table(const ContactSheet &sheet, const ContactLayout &layout, std::size_t table, Pen &pen) {
    pen.font(16.0, ink, true);
    pen.formula({ContactLayout::margin, layout.table(table) + 26.0}, sheet.tables[table].heading);
    for (std::size_t row = 0; row < sheet.tables[table].rows.size(); ++row) draw_row(sheet, layout, table, row, pen);
}

void draw_notes(const ContactSheet &sheet, const ContactLayout &layout, Pen &pen) {
    const double room = layout.page().width - 2.0 * ContactLayout::margin;
    pen.font(12.0, soft_ink);
    double baseline = layout.notes();
    for (const std::string &note : sheet.notes) {
        pen.text({ContactLayout::margin, baseline}, 0.0, note, room);
        baseline += ContactLayout::note_height;
    }
}

} // namespace

void write_contact_sheet(const ContactSheet &sheet, const std::filesystem::path &file) {
    const ContactLayout layout(sheet);
    Pen pen(layout.page(), layout.pixels_per_unit());
    draw_title(sheet, layout, pen);
    draw_column_headings(sheet, layout, pen);
    for (std::size_t table = 0; table < sheet.tables.size(); ++table) draw_table(sheet, layout, table, pen);
    draw_notes(sheet, layout, pen);
    pen.write_png(file);
}

} // namespace slopemix::cli
