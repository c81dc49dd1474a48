// The mixture about the half vector that the reference's sampler mis draws from: fitted to the measured table itself,
// for the theta_d at which it is asked for.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "brdf.h"
#include "material.h"

namespace smx {

class Proposal {
  public:
    explicit Proposal(std::shared_ptr<const Brdf> brdf) : brdf_(std::move(brdf)) {}

    // Weights sum to 1. Of the table's row nearest to theta_d, radians, or of all rows together. Empty where the table
    // is black there.
    const std::vector<Lobe> &lobes(double theta_d);
    const std::vector<Lobe> &lobes();

  private:
    const std::vector<Lobe> &of_rows(std::size_t first, std::size_t count);

    std::shared_ptr<const Brdf> brdf_;
    std::mutex mutex_;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Lobe>> fitted_; // by rows
};

} // namespace smx
