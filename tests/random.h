// Numbers that are the same on every machine for the same seed; the distributions of <random> are not.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "vec3.h"

namespace test {

class Random {
  public:
    explicit Random(uint64_t seed) : engine_(seed) {}

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

    // Uniform over the upper hemisphere, with z >= z_min.
    oracle::Vec direction(double z_min = 0.0) {
        const double z = uniform(z_min, 1.0), phi = uniform(0.0, 2.0 * oracle::pi);
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

  private:
    std::mt19937_64 engine_;
};

} // namespace test
