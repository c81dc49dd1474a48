#include "effect_flags.h"

#include <sstream>

namespace slopemix::cli {

namespace {

constexpr NumberRange tolerance_range = {0.0, 0.5};

std::vector<smx_effect> all_effects() {
    std::vector<smx_effect> effects;
    for (unsigned k = 0; k < SMX_EFFECT_COUNT; ++k) effects.push_back(static_cast<smx_effect>(1U << k));
    return effects;
}

std::uint32_t effect_named(const std::string &name) {
    std::string known;
    for (const smx_effect effect : all_effects()) {
        if (name == smx_effect_name(effect)) return effect;
        known.append(known.empty() ? "" : ", ").append(smx_effect_name(effect));
    }
    throw std::invalid_argument("'" + name + "' is no effect; there are " + known + ", and auto, all and none");
}

std::uint32_t parse_effects(const std::string &text) {
    if (text == "auto") return SMX_EFFECTS_AUTO;
    if (text == "all") return SMX_EFFECTS_ALL;
    if (text == "none") return SMX_EFFECTS_NONE;
    std::uint32_t effects = 0;
    std::istringstream names(text + ','); // so that an empty name at the end is one, too
    for (std::string name; std::getline(names, name, ',');) effects |= effect_named(name);
    return effects;
}

} // namespace

void add_effect_tolerance(CLI::App &command, RenderFlags &flags) {
    const auto parse = [](const std::string &text) { return parse_number(text, tolerance_range); };
    add_parsed(command, "--effect-tolerance", flags.effect_tolerance, parse,
               "relRMSE that a filtered image may have of all that --effects auto leaves out (default 0.001)")
        ->type_name("E");
}

void add_effect_flags(CLI::App &command, RenderFlags &flags) {
    flags.effects = SMX_EFFECTS_AUTO;
    std::string names;
    for (const smx_effect effect : all_effects())
        names.append(names.empty() ? "" : ", ").append(smx_effect_name(effect));
    add_parsed(command, "--effects", flags.effects, parse_effects,
               "What is simulated: what the image calls for, all that the integrator supports, nothing, or some of " +
                   names + " (default auto)")
        ->type_name("auto|all|none|LIST");
    add_effect_tolerance(command, flags);
}

void require_consistent_effects(const CLI::App &command, const RenderFlags &flags) {
    const bool named = flags.effects != SMX_EFFECTS_AUTO && flags.effects != SMX_EFFECTS_ALL;
    if (!named || command.count("--g") == 0) return;
    const bool correlated = (flags.effects & SMX_EFFECT_HEIGHT_CORRELATION) != 0;
    if (correlated != (flags.masking == SMX_G2_CORRELATED))
        throw CLI::ValidationError("--g", std::string("'") + word_for(flags.masking, maskings) +
                                              "' contradicts --effects, which " + (correlated ? "has" : "lacks") +
                                              " height-correlation; leave one of them out");
}

std::vector<std::string> effect_names(std::uint32_t effects) {
    std::vector<std::string> names;
    for (const smx_effect effect : all_effects())
        if (effects & effect) names.emplace_back(smx_effect_name(effect));
    return names;
}

std::string effects_text(std::uint32_t effects) {
    if (effects == SMX_EFFECTS_AUTO) return "auto";
    if (effects == SMX_EFFECTS_ALL) return "all";
    std::string text;
    for (const std::string &name : effect_names(effects)) text.append(text.empty() ? "" : ", ").append(name);
    return text.empty() ? "none" : text;
}

} // namespace slopemix::cli
