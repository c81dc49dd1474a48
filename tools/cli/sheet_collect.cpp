// A sheet from the records of its images.
#include <algorithm>
#include <set>

#include "input.h"
#include "sheet_record.h"

namespace slopemix::cli {

namespace {

bool same_fit(const SheetFit &a, const SheetFit &b) {
    return a.material_sha256 == b.material_sha256 && a.fitted_lobes == b.fitted_lobes &&
           a.log_likelihood == b.log_likelihood && a.residual == b.residual;
}

// One entry per model and number of lobes. All images of a fit must have it in common.
void add_fit(std::vector<SheetFit> &fits, const SheetRecord &record) {
    if (!record.fit) return;
    const SheetFit &fit = *record.fit;
    const auto is_its = [&](const SheetFit &other) { return other.model == fit.model && other.lobes == fit.lobes; };
    const auto found = std::find_if(fits.begin(), fits.end(), is_its);
    if (found == fits.end()) return fits.push_back(fit);
    if (!same_fit(*found, fit))
        throw CommandError(record.entry.file.string() + " is of another fit than the images before it, " +
                           word_for(fit.model, models) + ", N = " + std::to_string(fit.lobes) +
                           "; render them with the same --fit");
}

std::string joined(const std::set<std::string> &names) {
    std::string text;
    for (const std::string &name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

} // namespace

SheetResult collect_sheet(const SheetJob &job, const SheetPlan &plan) {
    SheetResult result;
    result.material = info_of(open_brdf(job.input));
    std::set<std::string> devices;
    for (const SheetImage &image : plan.images(job.only)) {
        const SheetRecord record = read_record(job, image, result.material);
        if (image.role == Role::filtered) read_record(job, plan.reference_of(image), result.material);
        devices.insert(record.device);
        add_fit(result.fits, record);
        result.entries.push_back(record.entry);
        result.earlier_seconds += record.entry.report.seconds;
        result.build_seconds += record.entry.report.build_seconds;
    }
    std::sort(result.fits.begin(), result.fits.end(), [](const SheetFit &a, const SheetFit &b) {
        return std::pair(a.model, a.lobes) < std::pair(b.model, b.lobes);
    });
    for (const SheetFit &fit : result.fits) result.earlier_seconds += fit.seconds;
    result.device = joined(devices);
    result.kept_images = result.entries.size();
    return result;
}

} // namespace slopemix::cli
