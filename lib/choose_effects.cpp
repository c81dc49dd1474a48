#include "choose_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.h"
#include "short_number.h"
#include "widening.h"

namespace smx {

namespace {

// Share of the tolerance that may be filled: a few hundred pixels tell an image's error to no better than that, and the
// closed form, by which effects are judged, that of an image by quadrature to less. It says nothing of where a
// quadrature's nodes would lie on another surface or in another model: there only what has no say is left out.
constexpr double safety = 0.4, safety_by_quadrature = 0.1;

constexpr Effects moving_nodes = anisotropy_effect | mean_slope_effect | lobe_color_effect;

constexpr std::size_t most_kept = 256;

void validate_tolerance(const RenderOptions &o) {
    require(o.effect_tolerance >= 0.0 && o.effect_tolerance < 1.0, "effect_tolerance is ", o.effect_tolerance,
            "; it must be 0 or more and below 1");
}

bool is_isotropic(const Displacement &x) { return x.alpha_x == x.alpha_y && (x.rho == 0.0 || x.alpha_x == 0.0); }

// What may be left out: an effect, or a lobe.
struct Candidate {
    double error; // 0 of an effect that has no say: a mean slope of 0, one alpha for both axes, one curve
    Effect effect;
    std::size_t lobe; // where effect is 0

    bool has_no_say() const { return effect && error == 0.0; }
    void leave_out(Simulated &simulated) const {
        if (effect)
            simulated.on &= ~static_cast<Effects>(effect);
        else
            simulated.lobes[lobe] = false;
    }
};

Candidate without_effect(const EffectTrial &trial, Effect effect) {
    Candidate c = {0.0, effect, 0};
    Simulated simulated = trial.all();
    c.leave_out(simulated);
    c.error = trial.error(simulated);
    return c;
}

// Leaves out one after the other, the least missed first, while all together stay within the tolerance.
Simulated least(const EffectTrial &trial, std::vector<Candidate> candidates, const RenderOptions &options) {
    const std::vector<double> shares = trial.lobe_shares();
    for (std::size_t k = 0; k < shares.size(); ++k) candidates.push_back({shares[k], {}, k});
    std::sort(candidates.begin(), candidates.end(), [](const auto &a, const auto &b) { return a.error < b.error; });
    const bool by_quadrature = options.widening_order != 0;
    const double budget = options.effect_tolerance * (by_quadrature ? safety_by_quadrature : safety);
    Simulated simulated = trial.all();
    for (const Candidate &candidate : candidates) {
        if (!(candidate.error <= budget)) break;
        if (candidate.has_no_say() || (by_quadrature && (candidate.effect & moving_nodes))) continue;
        Simulated less = simulated;
        candidate.leave_out(less);
        if (trial.error(less) <= budget) simulated = less;
    }
    return simulated;
}

// Without the effects that have no say in this image.
Effects with_say(Effects on, const std::vector<Candidate> &candidates) {
    for (const Candidate &candidate : candidates)
        if (candidate.has_no_say()) on &= ~static_cast<Effects>(candidate.effect);
    return without_lone_correlation(on);
}

std::string departure(double lambda, const char *direction) {
    return text("sigma departs from the cosine towards ", direction, " by at most ", short_number(lambda), " of it");
}

std::string curve_change(const Material &material, const Scene &scene) {
    const double angle = theta_d(scene);
    double change = 0.0, sum = 0.0;
    for (const FresnelCurves &curves : material.fresnel) {
        const Rgb at = fresnel_at(material.theta_d, curves, angle), first = fresnel_at(material.theta_d, curves, 0.0);
        for (std::size_t c = 0; c < 3; ++c) change += std::abs(at[c] - first[c]), sum += first[c];
    }
    const std::string range = text(" from theta_d 0 to ", short_number(angle * 180 / std::numbers::pi), " degrees");
    if (sum == 0.0) return "curves begin at 0";
    return text("curves vary by ", short_number(100 * change / sum), " %", range);
}

std::string axes(const Displacement &x) {
    if (is_isotropic(x)) return text("alpha is ", short_number(x.alpha_x), " along both axes");
    const PrincipalAxes a = principal_axes(x);
    return text("alphas are ", short_number(std::sqrt(a.var_1)), " and ", short_number(std::sqrt(a.var_2)),
                " along the principal axes");
}

std::string reason(Effect effect, const Material &material, const Scene &scene, const EffectTrial &trial, Effects on) {
    const Displacement &x = scene.displacement;
    switch (effect) {
        case masking_effect:
            return departure(trial.largest_lambda_o(), "wo");
        case shadowing_effect:
            return departure(trial.largest_lambda_i(), "wi");
        case height_correlation_effect:
            if (scene.masking == Masking::Separable) return "the scene's masking is separable";
            if (!(on & masking_effect) || !(on & shadowing_effect))
                return "nothing to correlate where facets are hidden from one direction at most";
            return "masking and shadowing overlap";
        case fresnel_effect:
            return curve_change(material, scene);
        case lobe_color_effect:
            if (material.model == Model::Shared) return "the shared model has one curve for all lobes";
            if (material.lobes.size() == 1) return "there is one lobe";
            return text(material.fresnel.size(), " lobes have their own curves");
        case anisotropy_effect:
            return axes(x);
        case mean_slope_effect:
            return text("the mean slope is (", short_number(x.mean_slope_x), ", ", short_number(x.mean_slope_y), ")");
        case interreflection_effect:
            return text("not simulated by filtered shading, but by the geometric reference; single scattering loses ",
                        short_number(100 * trial.lost_energy()), " % of the light");
    }
    fail(Fault::Internal, "no effect ", static_cast<std::uint32_t>(effect));
}

bool has_no_say(Effect effect, const Material &material, const Scene &scene) {
    const Displacement &x = scene.displacement;
    if (effect == lobe_color_effect) return material.model == Model::Shared || material.lobes.size() == 1;
    if (effect == anisotropy_effect) return is_isotropic(x);
    return effect == mean_slope_effect && x.mean_slope_x == 0.0 && x.mean_slope_y == 0.0;
}

std::vector<Candidate> candidates_of(const EffectTrial &trial, const Material &material, const Scene &scene) {
    std::vector<Candidate> candidates;
    for (const auto &[effect, name] : named_effects)
        if (trial.all().on & effect)
            candidates.push_back(has_no_say(effect, material, scene) ? Candidate{0.0, effect, 0}
                                                                     : without_effect(trial, effect));
    return candidates;
}

} // namespace

std::size_t EffectChoice::dropped() const {
    return static_cast<std::size_t>(std::count(simulated.lobes.begin(), simulated.lobes.end(), false));
}

Simulated everything(const Material &material, Effects asked, Masking masking) {
    return {requested_effects(asked, filtered_effects, "filtered shading", masking),
            std::vector<bool>(material.lobes.size(), true)};
}

EffectChoice choose_effects(const Material &material, const Scene &scene, const RenderOptions &options) {
    validate(scene);
    require_directional(scene);
    const Simulated asked = everything(material, options.effects, scene.masking);
    const Simulated all = everything(material, all_effects, scene.masking);
    const double start = now_seconds();
    const EffectTrial trial(material, scene, all);

    EffectChoice choice;
    choice.simulated = asked;
    std::vector<Candidate> candidates;
    if (!trial.is_black()) {
        candidates = candidates_of(trial, material, scene);
        if (options.effects == auto_effects) choice.simulated = least(trial, candidates, options);
        choice.left_out = trial.error(choice.simulated);
        if (options.effects == auto_effects) choice.simulated.on = with_say(choice.simulated.on, candidates);
    }
    for (const auto &[effect, name] : named_effects) {
        const auto judged = std::find_if(candidates.begin(), candidates.end(),
                                         [&, wanted = effect](const Candidate &c) { return c.effect == wanted; });
        const std::string why = trial.is_black() ? "the image is black: nothing was judged"
                                                 : reason(effect, material, scene, trial, choice.simulated.on);
        choice.verdicts.push_back({effect, (filtered_effects & effect) != 0, (choice.simulated.on & effect) != 0,
                                   judged == candidates.end() ? -1.0 : judged->error, why});
    }
    choice.seconds = now_seconds() - start;
    return choice;
}

EffectChoice EffectChoices::judged(const Scene &scene, const RenderOptions &options) {
    validate_tolerance(options);
    const std::scoped_lock lock(mutex_);
    const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const Kept &kept) {
        return kept.scene == scene && kept.effects == options.effects && kept.tolerance == options.effect_tolerance &&
               kept.order == options.widening_order;
    });
    if (same != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, same);
        kept_.front().choice.seconds = 0.0;
        return kept_.front().choice;
    }
    kept_.push_front({scene, options.effects, options.effect_tolerance, options.widening_order,
                      choose_effects(*material_, scene, options)});
    if (kept_.size() > most_kept) kept_.pop_back();
    return kept_.front().choice;
}

std::pair<Simulated, double> EffectChoices::simulated(const Scene &scene, const RenderOptions &options) {
    validate_tolerance(options);
    // Judged are images of one theta_d: of others auto is all.
    if (options.effects != auto_effects || scene.light == Light::Uniform)
        return {everything(*material_, options.effects, scene.masking), 0.0};
    const EffectChoice choice = judged(scene, options);
    return {choice.simulated, choice.seconds};
}

} // namespace smx
