#include "fill_holes.h"

#include <optional>

namespace smx {

namespace {

// Valid cells of one (theta_h, theta_d) row, in order of phi_d.
std::vector<std::size_t> valid_columns(const Brdf &grid, const std::vector<bool> &valid, std::size_t row_start) {
    std::vector<std::size_t> columns;
    for (std::size_t p = 0; p < grid.phi_d_count(); ++p)
        if (valid[row_start + p]) columns.push_back(p);
    return columns;
}

// Linear between the valid columns around each gap, the last one and the first being neighbours.
void fill_row(const Brdf &grid, const std::vector<std::size_t> &columns, double *row) {
    const std::size_t n = grid.phi_d_count();
    for (std::size_t j = 0; j < columns.size(); ++j) {
        const std::size_t left = columns[j];
        const std::size_t right = j + 1 < columns.size() ? columns[j + 1] : columns[0] + n;
        const double a = row[left], b = row[right % n];
        for (std::size_t p = left + 1; p < right; ++p) {
            const double share = static_cast<double>(p - left) / static_cast<double>(right - left);
            row[p % n] = a + (b - a) * share;
        }
    }
}

// For each of `count` places: the nearest one that is filled, the lower at a tie; nothing if there is none.
std::vector<std::optional<std::size_t>> nearest_filled(const std::vector<bool> &filled) {
    std::vector<std::optional<std::size_t>> nearest(filled.size());
    for (std::size_t k = 0; k < filled.size(); ++k)
        for (std::size_t far = 0; far < filled.size() && !nearest[k]; ++far) {
            if (k >= far && filled[k - far])
                nearest[k] = k - far;
            else if (k + far < filled.size() && filled[k + far])
                nearest[k] = k + far;
        }
    return nearest;
}

// Copies whole blocks of `size` values into those that are not filled. Returns whether any was filled.
bool fill_blocks(const std::vector<bool> &filled, std::size_t size, double *first) {
    const auto nearest = nearest_filled(filled);
    if (!nearest[0]) return false;
    for (std::size_t k = 0; k < filled.size(); ++k)
        for (std::size_t at = 0; !filled[k] && at < size; ++at) first[k * size + at] = first[*nearest[k] * size + at];
    return true;
}

} // namespace

void fill_holes(const Brdf &grid, const std::vector<bool> &valid, std::vector<double> &values) {
    const std::size_t n = grid.phi_d_count(), slab = Brdf::theta_d_count * n;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double *table = values.data() + channel * grid.cells();
        std::vector<bool> slabs_filled;
        for (std::size_t h = 0; h < Brdf::theta_h_count; ++h) {
            std::vector<bool> rows_filled;
            for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) {
                const auto columns = valid_columns(grid, valid, grid.cell(h, d, 0));
                fill_row(grid, columns, table + grid.cell(h, d, 0));
                rows_filled.push_back(!columns.empty());
            }
            slabs_filled.push_back(fill_blocks(rows_filled, n, table + grid.cell(h, 0, 0)));
        }
        fill_blocks(slabs_filled, slab, table);
    }
}

} // namespace smx
