// Welford's recurrence, which keeps its precision where the spread is far below the mean.
#include "run_statistics.h"

#include <cmath>

namespace slopemix::cli {

void RunStatistics::add(const Image &image) {
    if (runs_ == 0) {
        check(smx_image_get_size(image.get(), &width_, &height_));
        mean_.assign(std::size_t{4} * width_ * height_, 0.0);
    }
    ++runs_;
    values_ = 0;
    const float *pixels = smx_image_pixels(image.get());
    for (std::size_t pixel = 0; pixel < mean_.size(); pixel += 4) {
        mean_[pixel + 3] = static_cast<double>(pixels[pixel + 3]);
        if (!(pixels[pixel + 3] > 0.0f)) continue;
        for (std::size_t k = pixel; k < pixel + 3; ++k, ++values_) {
            const double before = static_cast<double>(pixels[k]) - mean_[k];
            mean_[k] += before / static_cast<double>(runs_);
            squares_ += before * (static_cast<double>(pixels[k]) - mean_[k]);
        }
    }
}

Image RunStatistics::mean() const {
    const std::vector<float> pixels(mean_.begin(), mean_.end());
    return acquire<Image>(smx_image_create, width_, height_, pixels.data());
}

double RunStatistics::deviation() const {
    if (runs_ < 2 || values_ == 0) return 0.0;
    return std::sqrt(squares_ / static_cast<double>((runs_ - 1) * values_));
}

} // namespace slopemix::cli
