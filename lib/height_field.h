// The surface of the geometric reference: a tileable Gaussian random height field, drawn in the space of its Fourier
// coefficients. One isotropic field of unit roughness stands for every displaced surface: an affine map of the plane
// and a shear turn one into the other, and neither changes what is in front of what (tile_frame.h).
//
// Heights stand at the corners of square cells of side 1, and every cell is two triangles, cut from (1, 0) to (0, 1).
// A facet's slopes are differences of heights, so that they are exactly Gaussian, whatever the cells resolve.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace smx {

constexpr std::uint32_t min_tile = 64, max_tile = 8192; // cells along a side, a power of two

// Heights have the correlation exp(-x^2 / (2 L^2)): L, in cells.
constexpr double correlation_length = 8.0;

struct HeightField {
    std::uint32_t log2_side = 0;
    std::vector<float> heights; // [side][side], periodic
    std::vector<float> maxima;  // of the cells, then of blocks of 2 x 2 of them, and so on to the whole tile
    float top = 0.0f;           // the largest height
    std::uint32_t side() const { return 1u << log2_side; }
};

// Two independent fields: the real and the imaginary part of one complex field. The same seed gives the same fields.
// Their scale is that of the ensemble, in which both slopes of a facet have twice the variance 1; a field's own
// variances scatter about it, and are not brought to 1: that would narrow what the ensemble is to tell.
std::array<HeightField, 2> make_height_fields(std::uint32_t log2_side, std::uint64_t seed);

// Correlation of the two slopes of a facet in the ensemble: a trace, since its edges are not where its middle is.
double facet_correlation(std::uint32_t log2_side);

} // namespace smx
