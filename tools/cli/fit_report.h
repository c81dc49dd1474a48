// What `fit` prints.
#pragma once

#include <vector>

#include "fit_job.h"

namespace slopemix::cli {

// The outcomes in the order of the inputs: as JSON, as the facts of a material where there was one input, else as a
// table with a line per material.
void print_fits(const FitJob &job, const std::vector<FitOutcome> &outcomes);

} // namespace slopemix::cli
