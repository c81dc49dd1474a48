// The contact sheet of the experiment: which pictures, headings and captions it has.
#include <algorithm>
#include <map>
#include <utility>

#include "contact_sheet.h"
#include "exposure.h"
#include "sheet_job.h"
#include "text.h"

namespace slopemix::cli {

namespace {

Picture to_picture(const Image &image, double exposure) {
    Picture picture = {};
    check(smx_image_get_size(image.get(), &picture.width, &picture.height));
    picture.rgb.resize(std::size_t{3} * picture.width * picture.height);
    check(smx_image_display(image.get(), exposure, picture.rgb.data(), picture.rgb.size()));
    return picture;
}

// Three significant places in the space of a few characters.
std::string caption(const SheetEntry &entry) {
    if (!entry.errors) return "";
    const double relrmse = entry.errors->relrmse;
    return relrmse < 10.0 ? fixed(relrmse, 3) : general(relrmse, 3);
}

class SheetCells {
  public:
    explicit SheetCells(const SheetResult &result) : result_(result) {
        for (const SheetEntry &entry : result.entries) entries_[entry.image.id] = &entry;
    }

    ContactSheet::Cell operator()(const ImageId &id) const {
        const auto found = entries_.find(id);
        if (found == entries_.end()) return {};
        const SheetEntry &entry = *found->second;
        const Image image = acquire<Image>(smx_image_read_exr, entry.file.c_str());
        return {to_picture(image, exposure_for(bright_of(entry.image))), caption(entry)};
    }

  private:
    double bright_of(const SheetImage &image) const {
        return image.has_light() ? result_.light_bright[image.light] : result_.geometry_bright;
    }

    const SheetResult &result_;
    std::map<ImageId, const SheetEntry *> entries_;
};

std::vector<ContactSheet::Group> column_groups(const SheetPlan &plan) {
    std::vector<std::string> columns = {"reference"};
    for (const std::uint32_t lobes : plan.lobes()) columns.push_back("N = " + std::to_string(lobes));
    std::vector<ContactSheet::Group> groups = {{"", {"geometry"}},
                                               {"light φ = 90° (at the camera)", columns},
                                               {"light φ = 0° (right)", columns},
                                               {"light φ = −25° (right, behind)", columns}};
    for (const std::int32_t order : plan.per_lobe_orders())
        groups.push_back({"per-lobe, N = " + std::to_string(plan.lobes().back()) +
                              (order == 0 ? "" : ", order " + widening_text(order)),
                          {"φ = 90°", "φ = 0°", "φ = −25°"}});
    return groups;
}

std::vector<ContactSheet::Table> tables(const SheetPlan &plan) {
    std::vector<std::string> rows;
    for (const double radius : plan.radii()) rows.push_back("r = " + general(radius, 4));
    return {{"Isotropic roughness, α_x = α_y = r", rows},
            {"Latitudinal roughness, α_x = r, α_y = 0", rows},
            {"Longitudinal roughness, α_x = 0, α_y = r", rows}};
}

} // namespace

void draw_sheet(const SheetJob &job, const SheetPlan &plan, const SheetResult &result,
                const std::filesystem::path &file) {
    const Resolution resolution = job.flags.resolution;
    ContactSheet sheet;
    sheet.title = result.material.name;
    sheet.subtitle = "A measured material on displaced spheres: reference against N widened Beckmann lobes. " +
                     std::to_string(resolution.width) + " × " + std::to_string(resolution.height) + " pixels, " +
                     "references of " + sampling_text(job.flags) + ".";
    sheet.groups = column_groups(plan);
    sheet.tables = tables(plan);
    sheet.notes = {
        "Under each filtered image: relRMSE = sqrt(mean (a − b)²) / sqrt(mean b²) against the reference b of its row "
        "and "
        "light.",
        "One exposure per light: the largest 99th percentile of its references shows at 0.9 (linear). slopemix " +
            std::string(smx_version()) + "."};
    sheet.resolution = resolution;
    sheet.cell_at = SheetCells(result);
    write_contact_sheet(sheet, file);
}

} // namespace slopemix::cli
