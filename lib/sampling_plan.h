// How a reference's samples are drawn: independent scrambles, each with one pass of facets per technique.
#pragma once

#include <cstdint>
#include <vector>

#include "material.h"
#include "render.h"

namespace smx {

enum class Drawing { Grid, Sobol, AboutZ };

constexpr std::uint32_t max_spp = 1u << 24;

struct Pass {
    Drawing drawing;
    std::uint32_t samples;
    std::uint32_t strata_1 = 1, strata_2 = 1; // of a grid
};

struct SamplingPlan {
    std::uint32_t scrambles;  // 1: no estimate of the error
    std::vector<Pass> passes; // of every scramble: facets of X, then perhaps as many about wh
    std::uint32_t samples_per_scramble() const;
    std::uint32_t samples() const { return scrambles * samples_per_scramble(); }
};

// Throws InvalidArgument, naming value and range.
void validate(const RenderOptions &options);

// As many as are `wanted` where each can have pairs of samples, else one.
std::uint32_t scrambles_of(std::uint32_t spp, std::uint32_t wanted);

// `scrambles` of them where spp is a multiple of twice as many, else one.
SamplingPlan sampling_plan(const Displacement &x, Sampler sampler, std::uint32_t spp, std::uint32_t scrambles);

// Under a uniform light, whose samples are facets and directions at once: one pass, whatever X is.
SamplingPlan uniform_plan(std::uint32_t spp, std::uint32_t scrambles);

// A seed for each pass of each scramble, without relation between them.
std::uint32_t pass_seed(std::uint64_t seed, std::uint32_t scramble, std::size_t pass);

// The proposal as kernels draw from it: cumulated weights and alphas. Where there are no lobes, one of alpha 1 that
// nothing is asked of: a buffer cannot be empty.
std::vector<cl_float2> cumulated(const std::vector<Lobe> &lobes);

// The proposal's density over solid angle at theta_h = (k/720)^2 pi/2, k = 0..720 (PROPOSAL_NODES in cl/proposal.clh).
std::vector<float> proposal_table(const std::vector<Lobe> &lobes);

} // namespace smx
