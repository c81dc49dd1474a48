// From an image's name T.R.C to what it shows.
#include "sheet_plan.h"

#include <stdexcept>
#include <utility>

namespace slopemix::cli {

namespace {

// Isotropic, latitudinal, longitudinal.
std::pair<double, double> alphas(std::uint32_t table, double radius) {
    return {table == 3 ? 0.0 : radius, table == 2 ? 0.0 : radius};
}

} // namespace

SheetPlan::SheetPlan(std::vector<double> radii, std::vector<std::uint32_t> lobes, std::vector<std::int32_t> orders,
                     const std::vector<ImageId> &only)
    : radii_(std::move(radii)), lobes_(std::move(lobes)), orders_(std::move(orders)), only_(only.begin(), only.end()) {
    for (const ImageId &id : only_)
        if (id.table > table_count || id.row > rows() || id.column > columns())
            throw std::invalid_argument("there is no image " + to_string(id) + ": this sheet has tables 1.." +
                                        std::to_string(table_count) + ", rows 1.." + std::to_string(rows()) +
                                        ", columns 1.." + std::to_string(columns()));
}

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

std::vector<ImageId> SheetPlan::filtered_under(const ImageId &reference, std::uint32_t light) const {
    std::vector<ImageId> ids;
    const auto add = [&](std::uint32_t column) {
        const ImageId id = {reference.table, reference.row, column};
        if (is_wanted(id)) ids.push_back(id);
    };
    for (std::uint32_t k = 1; k < per_light(); ++k) add(reference.column + k);
    for (std::uint32_t k = 0; k < orders_.size(); ++k) add(shared_columns() + 1 + k * lights + light);
    return ids;
}

std::vector<SheetStep> SheetPlan::steps() const {
    std::vector<SheetStep> steps;
    for (std::uint32_t table = 1; table <= table_count; ++table)
        for (std::uint32_t row = 1; row <= rows(); ++row) {
            const ImageId geometry = {table, row, 1};
            if (is_wanted(geometry)) steps.push_back({image(geometry), true});
            for (std::uint32_t light = 0; light < lights; ++light) {
                const ImageId reference = {table, row, 2 + light * per_light()};
                const std::vector<ImageId> filtered = filtered_under(reference, light);
                const bool wanted = is_wanted(reference);
                if (wanted || !filtered.empty()) steps.push_back({image(reference), wanted});
                for (const ImageId &id : filtered) steps.push_back({image(id), true});
            }
        }
    return steps;
}

} // namespace slopemix::cli
