// The sheet on disk while it is rendered. A finished image is in its place at once, and DIR/sheet.partial.json says so
// until the sheet is whole; DIR/sheet.json is there only while the images are the ones that it describes.
#pragma once

#include <optional>

#include "folder_lock.h"
#include "journal.h"
#include "sheet_job.h"

namespace slopemix::cli {

class SheetJournal {
  public:
    SheetJournal(const SheetJob &job, const SheetPlan &plan) : job_(job), plan_(plan) {}

    // `result` has its material and device. With --resume it receives what earlier runs finished and their times;
    // throws CommandError where that is of other settings, or damaged. An image that is no longer the one that was
    // finished is left out, and standard error says so. Locks the folder; what killed runs left half written goes from
    // it.
    void open(SheetResult &result);

    // --resume found the whole sheet.
    bool is_complete() const { return is_complete_; }

    // Puts the image in its place and in `result`. The first one takes away an earlier sheet.json and sheet.png.
    void keep(SheetEntry entry, const Image &image, SheetResult &result);

    // Something is there to resume.
    bool exists() const { return journal_ && journal_->exists(); }

    // The sheet is whole: the journal goes.
    void close() const { journal_->remove(); }

  private:
    void take_over(SheetResult &result);
    void require_complete(const Journal::Json &settings);
    void displace_earlier_sheet(const SheetResult &result);

    const SheetJob &job_;
    const SheetPlan &plan_;
    std::optional<FolderLock> lock_;
    std::optional<Journal> journal_;
    Journal::Json items_ = Journal::Json::array();
    bool is_complete_ = false;
    bool has_begun_ = false;
};

} // namespace slopemix::cli
