// Images of a sheet rendered one by one, by many calls at once: T.R.C.exr, and beside it T.R.C.json, its record, with
// the settings and the fit that it was made with. A record holds as long as the digest in it is its image's.
#pragma once

#include <optional>

#include "sheet_job.h"

namespace slopemix::cli {

struct SheetRecord {
    SheetEntry entry;
    std::optional<SheetFit> fit; // of a filtered image
    std::string device;
};

// Puts image and record in their places. Where the image is another one than that which was there, an earlier
// sheet.json and sheet.png, which describe that one, go.
void write_record(const SheetJob &job, const smx_brdf_info &material, SheetRecord record, const Image &image);

// Throws CommandError: no record, a damaged one, another image than it describes, or other settings.
SheetRecord read_record(const SheetJob &job, const SheetImage &image, const smx_brdf_info &material);

// Renders `only` these images, without those of which --resume finds the records. What was written, or there.
std::vector<SheetRecord> render_records(const SheetJob &job, const SheetPlan &plan);

} // namespace slopemix::cli
