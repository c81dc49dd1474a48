// The mixture that the reference's sampler mis draws from: a table's own, fitted when it is first asked for.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "brdf.h"
#include "material.h"

namespace smx {

class Proposal {
  public:
    explicit Proposal(std::shared_ptr<const Brdf> brdf) : brdf_(std::move(brdf)) {}

    // The shared model's lobes. Throws NoSolution for a table that cannot be fitted.
    const std::vector<Lobe> &lobes();

  private:
    std::shared_ptr<const Brdf> brdf_;
    std::once_flag fitted_;
    std::vector<Lobe> lobes_;
};

} // namespace smx
