// The materials of a sheet's filtered images: fitted to the table, or read from files of such fits.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "progress.h"
#include "sheet_job.h"

namespace slopemix::cli {

class SheetFits {
  public:
    // Throws CommandError where a file of the job is no fit of this table, or of another model or more lobes than its
    // column; wrong usage is a CLI::ValidationError.
    SheetFits(const SheetJob &job, const SheetPlan &plan, const Brdf &brdf);

    // What these images need; the inversion is done once for all fits, and only if one is wanted.
    void prepare(const std::vector<SheetImage> &images, Progress &progress);

    const Material &material_of(const SheetImage &filtered) const { return made_.at(key_of(filtered)).material; }
    const SheetFit &fit_of(const SheetImage &filtered) const { return made_.at(key_of(filtered)).fit; }
    std::vector<SheetFit> all() const; // that images needed, shared models first

  private:
    using Key = std::pair<smx_model, std::uint32_t>; // by the number of lobes asked for
    static Key key_of(const SheetImage &image) { return {image.model, image.lobes}; }
    struct Made {
        Material material;
        SheetFit fit;
    };

    Made read(const Key &key, const std::string &file) const;
    Made make(const Key &key, Progress &progress);

    const Brdf &brdf_;
    Density density_;
    std::map<Key, std::string> files_;
    std::map<Key, Made> made_;
};

} // namespace slopemix::cli
