// Renders any image of a sheet.
#pragma once

#include <vector>

#include "progress.h"
#include "renderings.h"
#include "sheet_fits.h"
#include "sheet_job.h"

namespace slopemix::cli {

class SheetPainter {
  public:
    // `images`: all that the command is about, of which the progress bar tells.
    SheetPainter(const SheetJob &job, const SheetPlan &plan, const std::vector<SheetImage> &images);

    smx_brdf_info material() const { return info_of(brdf_); }
    smx_device_info device() const { return info_of(context_); }
    const SheetFits &fits() const { return fits_; }

    void skip(const SheetImage &image); // an earlier run has rendered it
    void prepare(const std::vector<SheetImage> &images) { fits_.prepare(images, progress_); }
    Rendering paint(const SheetImage &image);

  private:
    Rendering render(const SheetImage &image);

    const SheetJob &job_;
    Progress progress_;
    Context context_;
    Brdf brdf_;
    SheetFits fits_;
};

} // namespace slopemix::cli
