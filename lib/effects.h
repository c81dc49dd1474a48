// What is simulated and what may be left out: the effects by name, which integrator can do without which, and what a
// material and a surface are without them. docs/effects.md defines each.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "context.h"
#include "material.h"
#include "scene.h"

namespace smx {

// A set of effects is a sum of these.
enum Effect : std::uint32_t {
    masking_effect = 1U << 0,
    shadowing_effect = 1U << 1,
    height_correlation_effect = 1U << 2,
    fresnel_effect = 1U << 3,
    lobe_color_effect = 1U << 4,
    anisotropy_effect = 1U << 5,
    mean_slope_effect = 1U << 6,
    interreflection_effect = 1U << 7,
};
using Effects = std::uint32_t;

struct NamedEffect {
    Effect effect;
    const char *name;
};
constexpr std::array<NamedEffect, 8> named_effects = {{{masking_effect, "masking"},
                                                       {shadowing_effect, "shadowing"},
                                                       {height_correlation_effect, "height-correlation"},
                                                       {fresnel_effect, "fresnel"},
                                                       {lobe_color_effect, "lobe-color"},
                                                       {anisotropy_effect, "anisotropy"},
                                                       {mean_slope_effect, "mean-slope"},
                                                       {interreflection_effect, "interreflection"}}};

// In place of a set: all that the integrator supports, or what the scene calls for (choose_effects.h).
constexpr Effects all_effects = 1U << 30, auto_effects = 1U << 31;

const char *name_of(Effect effect);
std::string effects_text(Effects on); // "masking,shadowing", "none"

// What an integrator simulates, and can leave out.
constexpr Effects surface_effects = masking_effect | shadowing_effect | anisotropy_effect | mean_slope_effect;
constexpr Effects filtered_effects = surface_effects | height_correlation_effect | fresnel_effect | lobe_color_effect;
constexpr Effects reference_effects = surface_effects | height_correlation_effect;
constexpr Effects geometric_effects = surface_effects | interreflection_effect;

// The set that is asked for, out of `supported`, of the integrator of this name; of auto and all, all. Throws
// InvalidArgument for a bit that is no effect's, an effect that the integrator does not support, and
// height-correlation where the scene's masking is separable.
Effects requested_effects(Effects asked, Effects supported, const char *integrator, Masking masking);

// Without height-correlation where there are not masking and shadowing to correlate.
Effects without_lone_correlation(Effects on);

// X without the effects that are off: one variance, the mean of its two, for both axes; no mean slope.
Displacement simplified(const Displacement &x, Effects on);

// A material without them: curves that are what they are at theta_d 0; one curve, the lobes' sum, and their energies as
// weights of the shared model.
Material simplified(const Material &material, Effects on);

// Takes away the lobes, and the curves of lobes that have their own, that are not kept; weights stay what they are.
void drop_lobes(Material &material, const std::vector<bool> &kept);

// For kernels that include cl/effects.clh: what hides facets, and all of them.
Defines masking_defines(Effects on);
Defines effect_defines(Effects on);

} // namespace smx
