// Every number that the device computes of a pair of directions (hard_truth.h), by the headers and kernels of cl/.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "context.h"
#include "grade.h"
#include "hard_truth.h"

namespace test {

class HardProbe {
  public:
    HardProbe(smx::Context &context, smx::Grade grade) : context_(context), grade_(grade) {}

    enum class Form {
        Full, // for any surface
        Least // without what this one has no use for: a second axis, a mean slope
    };

    // values[quantity][pair]; NaN where a quantity was not written.
    std::vector<std::vector<double>> run(const HardCase &c, const std::vector<HardPair> &pairs, Form form = Form::Full);

  private:
    // Build parameters of cl/effects.clh and cl/mixture.clh.
    struct Parts {
        bool per_lobe = false, masking = true, shadowing = true, correlated = true;
    };
    using Values = std::vector<std::vector<double>>;

    template <typename Real>
    void run_as(const HardCase &c, const std::vector<HardPair> &pairs, Form form, Values &values);
    // The kernel that writes what these parts have a say in; built once.
    cl::Kernel &kernel(const HardCase &c, Form form, const Parts &parts);

    smx::Context &context_;
    smx::Grade grade_;
    std::map<std::string, cl::Kernel> kernels_; // by build options
};

smx::Displacement displacement_of(const HardSurface &x);

} // namespace test
