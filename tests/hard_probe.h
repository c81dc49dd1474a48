// Every number that the device computes of a pair of directions (hard_truth.h), by the headers and kernels of cl/.
#pragma once

#include <vector>

#include "context.h"
#include "grade.h"
#include "hard_truth.h"

namespace test {

class HardProbe {
  public:
    HardProbe(smx::Context &context, smx::Grade grade);

    // values[quantity][pair]; NaN where a quantity was not written.
    std::vector<std::vector<double>> run(const HardCase &c, const std::vector<HardPair> &pairs);

  private:
    template <typename Real>
    void run_as(const HardCase &c, const std::vector<HardPair> &pairs, std::vector<std::vector<double>> &values);

    smx::Context &context_;
    smx::Grade grade_;
    std::vector<cl::Kernel> kernels_; // [model][masking]
};

smx::Displacement displacement_of(const HardSurface &x);

} // namespace test
