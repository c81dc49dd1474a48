// The fit of one input, from its file to the material's. Its object may be used from many threads.
#pragma once

#include <optional>

#include "fit_job.h"
#include "fit_source.h"
#include "fit_table.h"

namespace slopemix::cli {

class FitWorker {
  public:
    // `earlier` holds the rows of earlier runs.
    FitWorker(const FitJob &job, const FitTable &earlier);

    // Writes the material's file, unless it is up to date, and its picture. What fails is told in the outcome; throws
    // Cancelled only where nothing was finished.
    FitOutcome process(std::size_t index) const;

    // Of the kernels that pictures need, so far; nothing without pictures.
    std::optional<double> build_seconds() const;

  private:
    Material load_if_up_to_date(const FitSource &source) const;
    Fitted describe(const FitSource &source, const Material &material, bool up_to_date) const;
    void draw(FitSource &source, const Material &material) const;
    void fit_input(const std::string &input, FitOutcome &outcome) const;

    const FitJob &job_;
    const FitTable earlier_; // a copy: the table changes while the workers work
    Context context_;        // only for pictures
};

} // namespace slopemix::cli
