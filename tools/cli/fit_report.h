// What `fit` prints.
#pragma once

#include <optional>
#include <vector>

#include "fit_job.h"

namespace slopemix::cli {

// The outcomes in the order of the inputs: as JSON, as the facts of a material where there was one input, else as a
// table with a line per material. `build_seconds` are those of compiling kernels, where there were any.
void print_fits(const FitJob &job, const std::vector<FitOutcome> &outcomes, std::optional<double> build_seconds);

} // namespace slopemix::cli
