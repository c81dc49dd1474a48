// Mean and spread of several renderings of one image, pixel by pixel.
#pragma once

#include <cstddef>
#include <vector>

#include "handles.h"

namespace slopemix::cli {

class RunStatistics {
  public:
    // All images have the size and the surface of the first one.
    void add(const Image &image);

    std::size_t runs() const { return runs_; }
    Image mean() const;

    // Standard deviation of one run, as the root mean square over the surface's pixels and the channels: noise, without
    // what all runs have in common. 0 for one run.
    double deviation() const;

  private:
    std::uint32_t width_ = 0, height_ = 0;
    std::size_t runs_ = 0;
    std::vector<double> mean_; // [height][width][4]
    double squares_ = 0.0;     // sum of squared deviations from it
    std::size_t values_ = 0;   // of one run that are on the surface
};

} // namespace slopemix::cli
