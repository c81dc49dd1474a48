// Errors and exposures of a sheet, from the files of its images.
#include <algorithm>
#include <map>
#include <tuple>

#include "exposure.h"
#include "sheet_job.h"

namespace slopemix::cli {

namespace {

Image read(const std::filesystem::path &file) { return acquire<Image>(smx_image_read_exr, file.c_str()); }

class SheetMeasure {
  public:
    SheetMeasure(const SheetJob &job, const SheetPlan &plan, SheetResult &result)
        : job_(job), plan_(plan), result_(result) {}

    void measure(SheetEntry &entry) {
        switch (entry.image.role) {
            case Role::geometry:
                result_.geometry_bright = std::max(result_.geometry_bright, bright_value(read(entry.file)));
                break;
            case Role::reference:
                reference(entry.image);
                break;
            case Role::filtered:
                entry.errors = SMX_COMPARISON_INIT;
                check(smx_image_compare(read(entry.file).get(), reference(plan_.reference_of(entry.image)).get(),
                                        &*entry.errors));
                break;
        }
    }

  private:
    // Those of one row are in memory.
    const Image &reference(const SheetImage &image) {
        const auto row_of = [](const ImageId &id) { return std::tie(id.table, id.row); };
        if (!references_.empty() && row_of(references_.begin()->first) != row_of(image.id)) references_.clear();
        const auto [place, is_new] = references_.try_emplace(image.id);
        if (is_new) {
            place->second = read(job_.image_file(image.id));
            double &bright = result_.light_bright[image.light];
            bright = std::max(bright, bright_value(place->second));
        }
        return place->second;
    }

    const SheetJob &job_;
    const SheetPlan &plan_;
    SheetResult &result_;
    std::map<ImageId, Image> references_;
};

} // namespace

void measure_sheet(const SheetJob &job, const SheetPlan &plan, SheetResult &result) {
    SheetMeasure sheet(job, plan, result);
    for (SheetEntry &entry : result.entries) sheet.measure(entry);
}

} // namespace slopemix::cli
