#include "sampling_plan.h"

#include <cmath>
#include <numbers>

#include "brdf.h"
#include "error.h"

namespace smx {

namespace {

std::uint32_t square_side(std::uint32_t spp) {
    return static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(spp))));
}

Pass grid(std::uint32_t strata_1, std::uint32_t strata_2) {
    return {Drawing::Grid, strata_1 * strata_2, strata_1, strata_2};
}

} // namespace

// Of samples that come in pairs at the most.
std::uint32_t scrambles_of(std::uint32_t spp, std::uint32_t wanted) { return spp % (2 * wanted) == 0 ? wanted : 1; }

std::uint32_t SamplingPlan::samples_per_scramble() const {
    std::uint32_t sum = 0;
    for (const Pass &pass : passes) sum += pass.samples;
    return sum;
}

void validate(const RenderOptions &o) {
    require(o.sampler == Sampler::Grid || o.sampler == Sampler::Sobol || o.sampler == Sampler::Mis, "sampler is ",
            static_cast<int>(o.sampler), "; it must be 0 (grid), 1 (sobol) or 2 (mis)");
    require(o.lookup == Lookup::Linear || o.lookup == Lookup::Nearest, "lookup is ", static_cast<int>(o.lookup),
            "; it must be 0 or 1");
    require(o.spp >= 1 && o.spp <= max_spp, "spp is ", o.spp, "; it must be 1..", max_spp);
    if (o.sampler == Sampler::Grid) {
        const std::uint32_t side = square_side(o.spp);
        require(side * side == o.spp, "spp is ", o.spp, "; the grid needs a square, such as ", side * side);
    }
    if (o.sampler == Sampler::Mis) require(o.spp % 2 == 0, "spp is ", o.spp, "; mis needs an even number");
    require(o.scrambles == 8 || o.scrambles == 16 || o.scrambles == 32 || o.scrambles == 64, "scrambles is ",
            o.scrambles, "; it must be 8, 16, 32 or 64");
    require(o.target_error >= 0.0 && o.target_error < 1.0, "target_error is ", o.target_error,
            "; it must be at least 0 and below 1");
    require(o.target_error == 0.0 || o.sampler != Sampler::Grid,
            "target_error needs the sampler sobol or mis: a grid has no estimate of its error");
    require(!o.errors || o.sampler != Sampler::Grid,
            "errors need the sampler sobol or mis: a grid has no estimate of its error");
    require(!o.errors || o.target_error > 0.0 || o.spp % (2 * o.scrambles) == 0, "spp is ", o.spp,
            "; errors need a multiple of ", 2 * o.scrambles);
}

SamplingPlan sampling_plan(const Displacement &displacement, Sampler sampler, std::uint32_t spp, std::uint32_t wanted) {
    const PrincipalAxes x = rough_principal_axes(displacement);
    if (x.var_1 == 0.0 && x.var_2 == 0.0) return {1, {grid(1, 1)}};
    const std::uint32_t scrambles = sampler == Sampler::Grid ? 1 : scrambles_of(spp, wanted);
    const std::uint32_t samples = spp / scrambles;
    if (x.var_2 == 0.0) return {scrambles, {grid(samples, 1)}};
    if (x.var_1 == 0.0) return {scrambles, {grid(1, samples)}};
    switch (sampler) {
        case Sampler::Sobol:
            return {scrambles, {{Drawing::Sobol, samples}}};
        case Sampler::Mis:
            return {scrambles, {{Drawing::Sobol, samples / 2}, {Drawing::AboutZ, samples / 2}}};
        case Sampler::Grid:
            break;
    }
    return {1, {grid(square_side(spp), square_side(spp))}};
}

SamplingPlan uniform_plan(std::uint32_t spp, std::uint32_t wanted) {
    const std::uint32_t scrambles = scrambles_of(spp, wanted);
    return {scrambles, {{Drawing::Sobol, spp / scrambles}}};
}

std::uint32_t pass_seed(std::uint64_t seed, std::uint32_t scramble, std::size_t pass) {
    // SplitMix64 (Steele, Lea, Flood 2014) over the three.
    std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (1 + 2 * std::uint64_t{scramble} + pass);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::uint32_t>(z ^ (z >> 31));
}

std::vector<cl_float2> cumulated(const std::vector<Lobe> &lobes) {
    std::vector<cl_float2> out;
    double sum = 0.0;
    for (const auto &[weight, alpha] : lobes)
        out.push_back({{static_cast<float>(sum += weight), static_cast<float>(alpha)}});
    if (out.empty()) out.push_back({{1.0f, 1.0f}});
    return out;
}

std::vector<float> proposal_table(const std::vector<Lobe> &lobes) {
    constexpr std::size_t last = 8 * Brdf::theta_h_count;
    std::vector<float> table;
    for (std::size_t k = 0; k < last; ++k) {
        const double u = static_cast<double>(k) / last, theta = u * u * std::numbers::pi / 2;
        const double tangent = std::tan(theta), cosine = std::cos(theta);
        double density = 0.0;
        for (const auto &[weight, alpha] : lobes)
            density += weight / (std::numbers::pi * alpha * alpha) * std::exp(-tangent * tangent / (alpha * alpha));
        table.push_back(static_cast<float>(density / (cosine * cosine * cosine)));
    }
    table.push_back(0.0f); // at the horizon
    return table;
}

} // namespace smx
