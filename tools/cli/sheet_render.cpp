// A whole sheet: renders what no earlier run has finished, and keeps every image in the journal.
#include <algorithm>
#include <chrono>
#include <set>

#include "sheet_job.h"
#include "sheet_journal.h"
#include "sheet_painter.h"

namespace slopemix::cli {

namespace {

using Clock = std::chrono::steady_clock;

std::set<ImageId> ids_of(const std::vector<SheetEntry> &entries) {
    std::set<ImageId> ids;
    for (const SheetEntry &entry : entries) ids.insert(entry.image.id);
    return ids;
}

void note_times(SheetResult &result, Clock::time_point begin, const SheetPainter &painter) {
    const std::chrono::duration<double> elapsed = Clock::now() - begin;
    result.total_seconds = result.earlier_seconds + elapsed.count();
    result.build_seconds = result.earlier_build_seconds + painter.device().build_seconds;
}

} // namespace

SheetResult render_sheet(const SheetJob &job, const SheetPlan &plan, SheetJournal &journal) {
    const auto begin = Clock::now();
    const std::vector<SheetImage> images = plan.images({});
    SheetPainter painter(job, plan, images);
    SheetResult result;
    result.device = painter.device().name;
    result.material = painter.material();
    journal.open(result);
    if (journal.is_complete()) return result;

    const std::set<ImageId> kept = ids_of(result.entries);
    for (const ImageId &id : kept) painter.skip(plan.image(id));
    painter.prepare(images);
    result.fits = painter.fits().all();
    for (const SheetImage &image : images) {
        if (kept.contains(image.id)) continue;
        const Rendering rendering = painter.paint(image);
        note_times(result, begin, painter);
        journal.keep({image, job.image_file(image.id), rendering.report}, rendering.image, result);
    }
    std::sort(result.entries.begin(), result.entries.end(),
              [](const SheetEntry &a, const SheetEntry &b) { return a.image.id < b.image.id; });
    return result;
}

} // namespace slopemix::cli
