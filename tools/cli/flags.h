// Flags whose values are parsed and checked by us, and the flags that render, sheet and budget share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "parse.h"
#include "slopemix.h"

namespace slopemix::cli {

inline constexpr NumberRange alpha_range = {0.0, 1e4};
inline constexpr NumberRange light_range = {-1e6, 1e6}; // degrees
inline constexpr CountRange lobes_range = {1, SMX_MAX_LOBES};

inline constexpr Choice<smx_model> models[] = {{"shared", SMX_MODEL_SHARED}, {"per-lobe", SMX_MODEL_PER_LOBE}};
inline constexpr Choice<smx_sampler> samplers[] = {
    {"grid", SMX_SAMPLER_GRID}, {"sobol", SMX_SAMPLER_SOBOL}, {"mis", SMX_SAMPLER_MIS}};
inline constexpr Choice<smx_lookup> lookups[] = {{"linear", SMX_LOOKUP_LINEAR}, {"nearest", SMX_LOOKUP_NEAREST}};
inline constexpr Choice<smx_grade> grades[] = {
    {"fast", SMX_GRADE_FAST}, {"precise", SMX_GRADE_PRECISE}, {"double", SMX_GRADE_DOUBLE}};
inline constexpr Choice<std::uint32_t> scramble_counts[] = {{"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}};
inline constexpr Choice<smx_masking> maskings[] = {{"correlated", SMX_G2_CORRELATED}, {"separable", SMX_G2_SEPARABLE}};

// Adds an option that stores parse(text); what parse refuses is wrong usage. `target` must outlive the parsing.
template <class Target, class Parse>
CLI::Option *add_parsed(CLI::App &command, const std::string &flag, Target &target, Parse parse,
                        const std::string &help) {
    const auto store = [&target, parse, flag](const std::string &text) {
        try {
            target = parse(text);
        } catch (const std::invalid_argument &error) {
            throw CLI::ValidationError(flag, error.what());
        }
    };
    return command.add_option_function<std::string>(flag, store, help);
}

// The same for an option that may stand several times; what is given takes the place of the values that are there.
template <class Value, class Parse>
CLI::Option *add_repeated(CLI::App &command, const std::string &flag, std::vector<Value> &targets, Parse parse,
                          const std::string &help) {
    const auto store = [&targets, parse, flag](const std::vector<std::string> &texts) {
        targets.clear();
        try {
            for (const std::string &text : texts) targets.push_back(parse(text));
        } catch (const std::invalid_argument &error) {
            throw CLI::ValidationError(flag, error.what());
        }
    };
    return command.add_option_function<std::vector<std::string>>(flag, store, help)->allow_extra_args(false);
}

template <class Value, std::size_t count>
CLI::Option *add_choice(CLI::App &command, const std::string &flag, Value &target,
                        const Choice<Value> (&choices)[count], const std::string &help) {
    const auto parse = [&choices](const std::string &text) { return parse_choice(text, choices); };
    return add_parsed(command, flag, target, parse, help)->type_name(words_of(choices));
}

// What is fitted to a table.
struct FitFlags {
    smx_model model = SMX_MODEL_PER_LOBE;
    std::uint32_t lobes = 8;
    bool model_given = false; // by --model
};

void add_fit_flags(CLI::App &command, FitFlags &flags);

// All of them as they would be given: two fits of a table with the same text are the same fit.
std::string options_text(const FitFlags &flags);

// What every image of a command has in common.
struct RenderFlags {
    Resolution resolution = {128, 128};
    std::uint32_t spp = 65536;
    smx_sampler sampler = SMX_SAMPLER_MIS;
    double target_error = 0.0; // 0: spp samples
    std::uint32_t scrambles = 8;
    std::uint64_t seed = 0;
    smx_lookup lookup = SMX_LOOKUP_LINEAR;
    smx_masking masking = SMX_G2_CORRELATED;
    smx_grade grade = SMX_GRADE_PRECISE;
    std::int32_t widening_order = 0; // of filtered images
    double widening_tolerance = 0.02;
    std::uint32_t effects = SMX_EFFECTS_ALL; // an experiment leaves nothing out
    double effect_tolerance = 1e-3;          // of SMX_EFFECTS_AUTO
    std::string device;                      // empty: the library's choice
    std::uint32_t sub_devices = 0;

    bool has_auto_order() const { return widening_order == SMX_WIDENING_AUTO; }
};

void add_resolution_flag(CLI::App &command, RenderFlags &flags);
void add_seed_flag(CLI::App &command, RenderFlags &flags);
void add_device_flags(CLI::App &command, RenderFlags &flags); // --device and --sub-devices

// Resolution, masking and device: of an image that draws no samples.
void add_view_flags(CLI::App &command, RenderFlags &flags);

// Resolution, samples, seed and device; their help names the values in `flags` as the defaults.
void add_sampling_flags(CLI::App &command, RenderFlags &flags);

void add_grade_flag(CLI::App &command, RenderFlags &flags);

// These and the others.
void add_render_flags(CLI::App &command, RenderFlags &flags);

// 0..8, or auto as SMX_WIDENING_AUTO.
std::int32_t parse_widening_order(const std::string &text);
std::string widening_text(std::int32_t order);

// Lists of numbers of lobes and of orders, of which none stands twice.
std::vector<std::uint32_t> parse_lobe_counts(const std::string &text);
std::vector<std::int32_t> parse_widening_orders(const std::string &text);

// The order of filtered images, and the tolerance of auto.
void add_widening_flags(CLI::App &command, RenderFlags &flags);
void add_widening_tolerance(CLI::App &command, RenderFlags &flags);

// A tolerance where no order is auto is no error; but it is said.
void note_tolerance_without_effect(const CLI::App &command, bool is_auto);

// How a reference is sampled: "4096 samples per pixel" or "standard error 0.01".
std::string sampling_text(const RenderFlags &flags);

// Throws CLI::ValidationError if the samples give no estimate of the error.
void require_estimate(const RenderFlags &flags);

// Throws CLI::ValidationError if the sampler cannot take this number of samples, or has no error to reach.
void require_legal_sampling(const RenderFlags &flags);

} // namespace slopemix::cli
