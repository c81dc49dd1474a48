// From an image's name T.R.C to what it shows.
#include "sheet_plan.h"

#include <set>
#include <stdexcept>
#include <utility>

namespace slopemix::cli {

namespace {

// Isotropic, latitudinal, longitudinal.
std::pair<double, double> alphas(std::uint32_t table, double radius) {
    return {table == 3 ? 0.0 : radius, table == 2 ? 0.0 : radius};
}

} // namespace

SheetPlan::SheetPlan(std::vector<double> radii, std::vector<std::uint32_t> lobes, std::vector<std::int32_t> orders)
    : radii_(std::move(radii)), lobes_(std::move(lobes)), orders_(std::move(orders)) {}

SheetImage SheetPlan::image(ImageId id) const {
    const auto [alpha_x, alpha_y] = alphas(id.table, radii_[id.row - 1]);
    if (id.column == 1) return {id, Role::geometry, alpha_x, alpha_y, 0, 0};
    if (id.column > shared_columns()) {
        const std::uint32_t past = id.column - shared_columns() - 1;
        return {id,
                Role::filtered,
                alpha_x,
                alpha_y,
                past % lights,
                lobes_.back(),
                SMX_MODEL_PER_LOBE,
                orders_[past / lights]};
    }
    const std::uint32_t light = (id.column - 2) / per_light();
    const std::uint32_t position = (id.column - 2) % per_light();
    if (position == 0) return {id, Role::reference, alpha_x, alpha_y, light, 0};
    return {id, Role::filtered, alpha_x, alpha_y, light, lobes_[position - 1]};
}

std::vector<ImageId> SheetPlan::all() const {
    std::vector<ImageId> ids;
    for (std::uint32_t table = 1; table <= table_count; ++table)
        for (std::uint32_t row = 1; row <= rows(); ++row)
            for (std::uint32_t column = 1; column <= columns(); ++column) ids.push_back({table, row, column});
    return ids;
}

std::vector<SheetImage> SheetPlan::images(const std::vector<ImageId> &only) const {
    const std::vector<ImageId> ids = only.empty() ? all() : only;
    std::vector<SheetImage> images;
    for (const ImageId &id : std::set(ids.begin(), ids.end())) {
        if (id.table > table_count || id.row > rows() || id.column > columns())
            throw std::invalid_argument("there is no image " + to_string(id) + ": this sheet has tables 1.." +
                                        std::to_string(table_count) + ", rows 1.." + std::to_string(rows()) +
                                        ", columns 1.." + std::to_string(columns()));
        images.push_back(image(id));
    }
    return images;
}

SheetImage SheetPlan::reference_of(const SheetImage &filtered) const {
    return image({filtered.id.table, filtered.id.row, 2 + static_cast<std::uint32_t>(filtered.light) * per_light()});
}

} // namespace slopemix::cli
