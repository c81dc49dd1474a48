// The realisations of a geometric reference: height fields by number, made when they are asked for.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

#include "height_field.h"

namespace smx {

// Several devices may ask. What was made is kept while all of it takes less than 256 MiB, and else made again.
class HeightFields {
  public:
    HeightFields(std::uint32_t log2_side, std::uint64_t seed) : log2_side_(log2_side), seed_(seed) {}
    std::shared_ptr<const HeightField> get(std::uint32_t realisation);

  private:
    using Pair = std::array<HeightField, 2>;
    std::shared_ptr<const Pair> pair(std::uint32_t number);

    const std::uint32_t log2_side_;
    const std::uint64_t seed_;
    std::mutex mutex_;
    std::map<std::uint32_t, std::shared_ptr<const Pair>> kept_;
};

} // namespace smx
