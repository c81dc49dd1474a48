#include "effects.h"

#include <cmath>
#include <numbers>

#include "error.h"

namespace smx {

namespace {

constexpr Effects every_effect = (1U << named_effects.size()) - 1;

// The sum of the lobes' curves.
FresnelCurves summed(const std::vector<FresnelCurves> &sets) {
    FresnelCurves sum = sets.front();
    for (std::size_t k = 1; k < sets.size(); ++k)
        for (std::size_t c = 0; c < sum.size(); ++c)
            for (std::size_t j = 0; j < sum[c].size(); ++j) sum[c][j] += sets[k][c][j];
    return sum;
}

} // namespace

const char *name_of(Effect effect) {
    for (const NamedEffect &named : named_effects)
        if (named.effect == effect) return named.name;
    fail(Fault::Internal, "no effect ", static_cast<std::uint32_t>(effect));
}

std::string effects_text(Effects on) {
    std::string list;
    for (const auto &[effect, name] : named_effects)
        if (on & effect) list.append(list.empty() ? "" : ",").append(name);
    return list.empty() ? "none" : list;
}

Effects requested_effects(Effects asked, Effects supported, const char *integrator, Masking masking) {
    const bool separable = masking == Masking::Separable;
    if (asked == auto_effects || asked == all_effects)
        return separable ? supported & ~height_correlation_effect : supported;
    require((asked & ~every_effect) == 0, "effects is ", asked, "; it must be auto (", auto_effects, "), all (",
            all_effects, ") or a sum of effects, at most ", every_effect);
    require((asked & ~supported) == 0, "effects has ", effects_text(asked & ~supported), ", which ", integrator,
            " does not simulate; it takes ", effects_text(supported));
    require(!separable || !(asked & height_correlation_effect),
            "effects has height-correlation, and the scene's masking is separable; leave one of them out");
    return without_lone_correlation(asked);
}

Effects without_lone_correlation(Effects on) {
    const bool both = (on & masking_effect) && (on & shadowing_effect);
    return both ? on : on & ~static_cast<Effects>(height_correlation_effect);
}

Displacement simplified(const Displacement &x, Effects on) {
    Displacement simple = x;
    if (!(on & anisotropy_effect)) {
        simple.alpha_x = simple.alpha_y = std::hypot(x.alpha_x, x.alpha_y) / std::numbers::sqrt2;
        simple.rho = 0.0;
    }
    if (!(on & mean_slope_effect)) simple.mean_slope_x = simple.mean_slope_y = 0.0;
    return simple;
}

Material simplified(const Material &material, Effects on) {
    Material simple = material;
    if (!(on & lobe_color_effect) && material.model == Model::PerLobe) {
        simple.model = Model::Shared; // whose weights the per-lobe model has too (material.h)
        simple.fresnel = {summed(material.fresnel)};
    }
    if (!(on & fresnel_effect)) {
        for (FresnelCurves &curves : simple.fresnel)
            for (std::vector<double> &curve : curves) curve = {curve.front(), curve.front()};
        simple.theta_d = {0.0, std::numbers::pi / 2};
    }
    return simple;
}

void drop_lobes(Material &material, const std::vector<bool> &kept) {
    const bool own_curves = material.model == Model::PerLobe;
    std::size_t left = 0;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (!kept[k]) continue;
        material.lobes[left] = material.lobes[k];
        if (own_curves && left != k) material.fresnel[left] = std::move(material.fresnel[k]);
        ++left;
    }
    material.lobes.resize(left);
    if (own_curves) material.fresnel.resize(left);
}

Defines masking_defines(Effects on) {
    const bool masking = (on & masking_effect) != 0, shadowing = (on & shadowing_effect) != 0;
    // Of one alone there is nothing to correlate: no variant more.
    const bool correlated = (on & height_correlation_effect) != 0 || !masking || !shadowing;
    return {{"MASKING", masking}, {"SHADOWING", shadowing}, {"HEIGHT_CORRELATION", correlated}};
}

Defines effect_defines(Effects on) {
    Defines defines = masking_defines(on);
    defines["FRESNEL"] = (on & fresnel_effect) != 0;
    defines["ANISOTROPY"] = (on & anisotropy_effect) != 0;
    defines["MEAN_SLOPE"] = (on & mean_slope_effect) != 0;
    return defines;
}

} // namespace smx
