#include "pilot_pixels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace smx {

namespace {

constexpr std::uint32_t most_blocks = 128; // along the smaller side

struct Block {
    LocalDirections pixel;
    double brightness;
};

// One lit pixel of each block, at a place of its own: a regular lattice would miss lines.
std::vector<Block> lit_blocks(const Scene &scene, std::uint32_t side, const Image &brightness) {
    std::mt19937 generator(1);
    const auto within = [&] { return static_cast<std::uint32_t>(generator() % side); };
    std::vector<Block> blocks;
    for (std::uint32_t r = 0; r < brightness.height; ++r)
        for (std::uint32_t c = 0; c < brightness.width; ++c) {
            const std::uint32_t column = c * side + within(), row = r * side + within();
            if (column >= scene.width || row >= scene.height) continue;
            const auto pixel = lit_pixel(scene, column, row);
            const float *rgba = brightness.rgba.data() + 4 * (std::size_t{r} * brightness.width + c);
            if (pixel) blocks.push_back({*pixel, double{rgba[0]} + rgba[1] + rgba[2]});
        }
    return blocks;
}

// Shares of the draws, summing to 1. Errors that grow with the pixel's value, with its root and not at all: a third of
// the draws for the squares of each.
std::vector<double> shares(const std::vector<Block> &blocks) {
    double sum = 0.0, sum2 = 0.0;
    for (const Block &b : blocks) sum += b.brightness, sum2 += b.brightness * b.brightness;
    std::vector<double> shares;
    for (const Block &b : blocks) {
        const double even = 1.0 / static_cast<double>(blocks.size());
        const bool black = !(sum2 > 0.0);
        shares.push_back(black ? even : (b.brightness * b.brightness / sum2 + b.brightness / sum + even) / 3.0);
    }
    return shares;
}

// Probabilities min(1, k share) that sum to `wanted`, for the k at which they do.
std::vector<double> probabilities(const std::vector<double> &shares, std::size_t wanted) {
    std::vector<double> sorted = shares;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    // The n largest are certain; the rest have what is left of the draws.
    double rest = 1.0, k = static_cast<double>(wanted);
    for (std::size_t n = 0; n < wanted && k * sorted[n] > 1.0; ++n) {
        rest -= sorted[n];
        k = static_cast<double>(wanted - n - 1) / rest;
    }
    std::vector<double> probabilities;
    for (double share : shares) probabilities.push_back(std::min(1.0, k * share));
    return probabilities;
}

} // namespace

PilotPixels pilot_pixels(const Scene &scene, std::size_t wanted,
                         const std::function<Image(const Scene &scene)> &brightness) {
    const std::uint32_t side = (std::min(scene.width, scene.height) + most_blocks - 1) / most_blocks;
    Scene coarse = scene;
    coarse.width = (scene.width + side - 1) / side;
    coarse.height = (scene.height + side - 1) / side;
    const std::vector<Block> blocks = lit_blocks(scene, side, brightness(coarse));
    const bool all = blocks.size() <= wanted;
    const std::vector<double> probability =
        all ? std::vector<double>(blocks.size(), 1.0) : probabilities(shares(blocks), wanted);

    // Systematic drawing: a pixel for every whole number that the sum of the probabilities passes.
    PilotPixels pixels;
    double sum = all ? 0.0 : 0.5;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const double before = sum;
        sum += probability[k];
        if (probability[k] < 1.0 && std::floor(sum) == std::floor(before)) continue;
        for (double v : blocks[k].pixel.wi) pixels.wi.push_back(static_cast<float>(v));
        for (double v : blocks[k].pixel.wo) pixels.wo.push_back(static_cast<float>(v));
        pixels.weight.push_back(1.0 / probability[k]);
    }
    return pixels;
}

} // namespace smx
