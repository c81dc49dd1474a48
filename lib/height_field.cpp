#include "height_field.h"

#include <kiss_fftnd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <numbers>
#include <random>

namespace smx {

namespace {

using std::numbers::pi;

// Frequencies along an axis that have a share worth drawing: beyond 6.5 / L it is below 1e-9 of the largest.
std::int32_t highest_frequency(std::int32_t side) {
    return std::min(static_cast<std::int32_t>(6.5 * side / (2 * pi * correlation_length)), side / 2 - 1);
}

double wave_number(std::int32_t frequency, std::int32_t side) { return 2 * pi * frequency / side; }

// The power spectrum of exp(-x^2 / (2 L^2)), but for its scale: one axis's factor.
double power(double k) { return std::exp(-0.5 * k * k * correlation_length * correlation_length); }

// Sums over one axis's frequencies: of the power, and of the power times 1 - cos k, half the variance of a difference
// between neighbours. The mean height, the coefficient at 0, has no slopes; it is left out of the field only.
struct AxisSums {
    double power = 0.0, difference = 0.0;
};

AxisSums axis_sums(std::int32_t side) {
    AxisSums sums;
    for (std::int32_t f = -highest_frequency(side); f <= highest_frequency(side); ++f) {
        const double k = wave_number(f, side);
        sums.power += power(k);
        sums.difference += power(k) * (1.0 - std::cos(k));
    }
    return sums;
}

// Standard normal numbers in pairs (Box, Muller 1958), alike wherever the library of <cmath> is.
std::array<double, 2> normal_pair(std::mt19937_64 &random) {
    const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
    const double radius = std::sqrt(-2.0 * std::log(uniform())), phi = 2 * pi * uniform();
    return {radius * std::cos(phi), radius * std::sin(phi)};
}

// Independent complex coefficients at the frequencies that have a share.
std::vector<kiss_fft_cpx> coefficients(std::int32_t side, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const AxisSums sums = axis_sums(side);
    const double scale = 1.0 / std::sqrt(4.0 * sums.difference * sums.power); // twice the variance of a slope is 1
    std::vector<kiss_fft_cpx> out(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    const std::int32_t highest = highest_frequency(side);
    for (std::int32_t y = -highest; y <= highest; ++y)
        for (std::int32_t x = -highest; x <= highest; ++x) {
            const double share = power(wave_number(x, side)) * power(wave_number(y, side));
            const double amplitude = x == 0 && y == 0 ? 0.0 : scale * std::sqrt(share);
            const auto [re, im] = normal_pair(random);
            const auto row = static_cast<std::size_t>((y + side) % side),
                       column = static_cast<std::size_t>((x + side) % side);
            out[row * static_cast<std::size_t>(side) + column] = {static_cast<float>(amplitude * re),
                                                                  static_cast<float>(amplitude * im)};
        }
    return out;
}

std::vector<kiss_fft_cpx> transformed(const std::vector<kiss_fft_cpx> &in, std::int32_t side) {
    const std::array<int, 2> sides = {side, side};
    struct Free {
        void operator()(kiss_fftnd_cfg plan) const { std::free(plan); } // as kiss_fft.h says: it comes from malloc
    };
    const std::unique_ptr<kiss_fftnd_state, Free> plan(kiss_fftnd_alloc(sides.data(), 2, 1, nullptr, nullptr));
    if (!plan) throw std::bad_alloc();
    std::vector<kiss_fft_cpx> out(in.size());
    kiss_fftnd(plan.get(), in.data(), out.data());
    return out;
}

// The highest corner of every cell, then of four blocks of the level below at a time.
std::vector<float> maxima_of(const std::vector<float> &heights, std::size_t side) {
    std::vector<float> maxima;
    maxima.reserve(heights.size() / 3 * 4 + 1);
    for (std::size_t y = 0; y < side; ++y) {
        const float *row = heights.data() + y * side, *next = heights.data() + (y + 1) % side * side;
        for (std::size_t x = 0; x < side; ++x) {
            const std::size_t right = (x + 1) % side;
            maxima.push_back(std::max(std::max(row[x], row[right]), std::max(next[x], next[right])));
        }
    }
    for (std::size_t below = 0; side > 1; side /= 2) {
        for (std::size_t y = 0; y < side; y += 2)
            for (std::size_t x = 0; x < side; x += 2) {
                const std::size_t at = below + y * side + x;
                maxima.push_back(
                    std::max(std::max(maxima[at], maxima[at + 1]), std::max(maxima[at + side], maxima[at + side + 1])));
            }
        below += side * side;
    }
    return maxima;
}

} // namespace

std::array<HeightField, 2> make_height_fields(std::uint32_t log2_side, std::uint64_t seed) {
    const auto side = static_cast<std::int32_t>(1u << log2_side);
    const std::vector<kiss_fft_cpx> field = transformed(coefficients(side, seed), side);
    std::array<HeightField, 2> fields;
    for (std::size_t part = 0; part < 2; ++part) {
        HeightField &f = fields[part];
        f.log2_side = log2_side;
        f.heights.reserve(field.size());
        for (const kiss_fft_cpx &z : field) f.heights.push_back(part == 0 ? z.r : z.i);
        f.maxima = maxima_of(f.heights, f.side());
        f.top = f.maxima.back();
    }
    return fields;
}

double facet_correlation(std::uint32_t log2_side) {
    const AxisSums sums = axis_sums(static_cast<std::int32_t>(1u << log2_side));
    // Of the slopes h(1,0) - h(0,0) and h(0,1) - h(0,0): covariance difference^2, variances 2 difference power.
    return sums.difference / (2.0 * sums.power);
}

} // namespace smx
