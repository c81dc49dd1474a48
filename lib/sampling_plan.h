// How a reference's samples are drawn: independent scrambles, each with one pass of facets per technique.
#pragma once

#include <cstdint>
#include <vector>

#include "material.h"
#include "render.h"

namespace smx {

// As TECHNIQUE in cl/integrate_reference.cl.
enum class Technique { FromX = 0, FromXBalanced = 1, AboutWhBalanced = 2 };

enum class Drawing { Grid, Sobol, AboutZ };

constexpr std::uint32_t max_spp = 1u << 24;

struct Pass {
    Technique technique;
    Drawing drawing;
    std::uint32_t samples;
    std::uint32_t strata_1 = 1, strata_2 = 1; // of a grid
};

struct SamplingPlan {
    std::uint32_t scrambles;  // 1: no estimate of the error
    std::vector<Pass> passes; // of every scramble
    std::uint32_t samples_per_scramble() const;
    std::uint32_t samples() const { return scrambles * samples_per_scramble(); }
};

// Throws InvalidArgument, naming value and range.
void validate(const RenderOptions &options);

SamplingPlan sampling_plan(const Displacement &x, Sampler sampler, std::uint32_t spp);

// A seed for each pass of each scramble, without relation between them.
std::uint32_t pass_seed(std::uint64_t seed, std::uint32_t scramble, std::size_t pass);

// The proposal as kernels draw from it: cumulated weights and alphas.
std::vector<cl_float2> cumulated(const std::vector<Lobe> &lobes);

// The proposal's density over solid angle at the table's rows theta_h = (k/90)^2 pi/2, k = 0..90.
std::vector<float> proposal_table(const std::vector<Lobe> &lobes);

} // namespace smx
