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

SheetPlan::SheetPlan(std::vector<double> radii, std::vector<std::uint32_t> lobes, const std::vector<ImageId> &only)
    : radii_(std::move(radii)), lobes_(std::move(lobes)), only_(only.begin(), only.end()) {
    for (const ImageId &id : only_)
        if (id.table > table_count || id.row > rows() || id.column > columns())
            throw std::invalid_argument("there is no image " + to_string(id) + ": this sheet has tables 1.." +
                                        std::to_string(table_count) + ", rows 1.." + std::to_string(rows()) +
                                        ", columns 1.." + std::to_string(columns()));
}

SheetImage SheetPlan::image(ImageId id) const {
    const auto [alpha_x, alpha_y] = alphas(id.table, radii_[id.row - 1]);
    if (id.column == 1) return {id, Role::geometry, alpha_x, alpha_y, 0, 0};
    const std::uint32_t light = (id.column - 2) / per_light();
    const std::uint32_t position = (id.column - 2) % per_light();
    if (position == 0) return {id, Role::reference, alpha_x, alpha_y, light, 0};
    return {id, Role::filtered, alpha_x, alpha_y, light, lobes_[position - 1]};
}

std::vector<SheetStep> SheetPlan::steps() const {
    std::vector<SheetStep> steps;
    for (std::uint32_t table = 1; table <= table_count; ++table)
        for (std::uint32_t row = 1; row <= rows(); ++row)
            for (std::uint32_t column = 1; column <= columns(); ++column) {
                const SheetImage candidate = image({table, row, column});
                const bool wanted = is_wanted(candidate.id);
                if (wanted || (candidate.role == Role::reference && is_compared_with(candidate.id)))
                    steps.push_back({candidate, wanted});
            }
    return steps;
}

bool SheetPlan::is_compared_with(const ImageId &reference) const {
    for (std::uint32_t k = 1; k < per_light(); ++k)
        if (is_wanted({reference.table, reference.row, reference.column + k})) return true;
    return false;
}

} // namespace slopemix::cli
