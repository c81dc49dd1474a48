// A sweep on disk while it is measured: the truth is in its place at once, and DIR/tradeoff.partial.json lists the
// finished points until tradeoff.json, .csv and .svg end the sweep.
#pragma once

#include <optional>

#include "folder_lock.h"
#include "journal.h"
#include "tradeoff_job.h"

namespace slopemix::cli {

class TradeoffJournal {
  public:
    explicit TradeoffJournal(const TradeoffJob &job) : job_(job) {}

    // `result` has its material and device. With --resume it receives what earlier runs finished: truth, fits, points
    // and times; throws CommandError where that is of other settings, or damaged. A truth that is no longer the one
    // that was finished is left out, and the points with it. Locks the folder.
    void open(const std::vector<Configuration> &plan, TradeoffResult &result);

    // --resume found the whole sweep.
    bool is_complete() const { return is_complete_; }

    // Puts the truth into its file; and notes a measured point, which is the last one of `result`.
    void keep_truth(const TradeoffResult &result);
    void keep_point(const TradeoffResult &result);

    // Something is there to resume.
    bool exists() const { return journal_ && journal_->exists(); }

    // The sweep is whole: the journal goes.
    void close() const { journal_->remove(); }

  private:
    void take_over(const std::vector<Configuration> &plan, TradeoffResult &result);
    void require_complete(const Journal::Json &settings);

    const TradeoffJob &job_;
    std::optional<FolderLock> lock_;
    std::optional<Journal> journal_;
    std::string truth_sha256_;
    bool is_complete_ = false;
};

} // namespace slopemix::cli
