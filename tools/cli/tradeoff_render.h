// Renders any configuration of a sweep; a fit is made when it is first needed.
#pragma once

#include <map>
#include <utility>

#include "progress.h"
#include "renderings.h"
#include "tradeoff_job.h"

namespace slopemix::cli {

class TradeoffRenderer {
  public:
    TradeoffRenderer(const TradeoffJob &job, Progress &progress);

    const Context &context() const { return context_; }
    const Brdf &brdf() const { return brdf_; }

    // `run` counts the seeds.
    Rendering render(const Configuration &configuration, std::uint32_t run);

    // By mis, at this many samples for each of its halves: of the measured table, and of a fitted base's.
    GroundTruth truth(std::uint32_t samples);
    GroundTruth base_truth(const Configuration &filter, std::uint32_t samples);

    struct Fit {
        Material material;
        double seconds; // the inversion apart
    };
    const Fit &fit(const Configuration &filter);

    // 4 for each number that shading keeps of the material: the table's cells, or lobes and curves.
    std::uint64_t bytes(const Configuration &configuration);

  private:
    GroundTruth truth_of(const Brdf &table, std::uint32_t samples, const std::string &what);
    smx_render_options options();

    const TradeoffJob &job_;
    Progress &progress_;
    Context context_;
    Brdf brdf_;
    Density density_;
    std::map<std::pair<Method, std::uint32_t>, Fit> fits_;
    smx_scene scene_;
};

} // namespace slopemix::cli
