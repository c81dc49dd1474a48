// The flags that render, sheet and budget share.
#include "flags.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "text.h"

namespace slopemix::cli {

namespace {

constexpr CountRange spp_range = {1, 1u << 24};
constexpr CountRange sub_devices_range = {1, 1u << 16};
constexpr NumberRange target_error_range = {1e-6, 0.5};
constexpr NumberRange tolerance_range = {1e-6, 0.5};
constexpr CountRange order_range = {0, SMX_WIDENING_MAX_ORDER};

bool is_square(std::uint32_t value) {
    const auto root = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(value))));
    return root * root == value;
}

void require_distinct(const std::string &text, const auto &values, auto to_text) {
    for (auto later = values.begin(); later != values.end(); ++later)
        if (std::find(values.begin(), later, *later) != later)
            throw std::invalid_argument("'" + text + "' names " + to_text(*later) + " twice");
}

} // namespace

void add_fit_flags(CLI::App &command, FitFlags &flags) {
    const auto parse_lobes = [](const std::string &text) {
        if (text == "auto") return SMX_LOBES_AUTO;
        return static_cast<std::uint32_t>(parse_count(text, lobes_range));
    };
    add_parsed(command, "--lobes", flags.lobes, parse_lobes,
               "Beckmann lobes to fit, 1 to 64, or auto: as few as explain the material (default 8)")
        ->type_name("N");
    add_choice(command, "--model", flags.model, models,
               "One Fresnel curve per channel for all lobes, or one for each (default per-lobe)")
        ->each([&flags](const std::string &) { flags.model_given = true; });
}

std::string options_text(const FitFlags &flags) {
    return std::string("--model ") + word_for(flags.model, models) + " --lobes " +
           (flags.lobes == SMX_LOBES_AUTO ? "auto" : std::to_string(flags.lobes));
}

namespace {

void add_masking_flag(CLI::App &command, RenderFlags &flags) {
    add_choice(command, "--g", flags.masking, maskings,
               "Masking and shadowing, height-correlated or separable (default correlated)");
}

void add_device_flag(CLI::App &command, RenderFlags &flags) {
    command
        .add_option("--device", flags.device,
                    "OpenCL device: its number in `slopemix info`, or part of its name; several work together")
        ->type_name("D[,D...]");
}

} // namespace

void add_resolution_flag(CLI::App &command, RenderFlags &flags) {
    add_parsed(command, "--res", flags.resolution, parse_resolution,
               "Resolution, one number for a square; the sphere fits the smaller side (default 128)")
        ->type_name("W[xH]");
}

void add_seed_flag(CLI::App &command, RenderFlags &flags) {
    const auto parse_seed = [](const std::string &text) { return parse_count(text, {0, UINT64_MAX}); };
    add_parsed(command, "--seed", flags.seed, parse_seed, "Seed of the reference (default 0)")->type_name("S");
}

void add_device_flags(CLI::App &command, RenderFlags &flags) {
    add_device_flag(command, flags);
    const auto parse_parts = [](const std::string &text) {
        return static_cast<std::uint32_t>(parse_count(text, sub_devices_range));
    };
    add_parsed(command, "--sub-devices", flags.sub_devices, parse_parts,
               "Cut each device into N like sub-devices, which work together (default 1)")
        ->type_name("N");
}

void add_view_flags(CLI::App &command, RenderFlags &flags) {
    add_resolution_flag(command, flags);
    add_masking_flag(command, flags);
    add_device_flag(command, flags);
}

void add_sampling_flags(CLI::App &command, RenderFlags &flags) {
    add_resolution_flag(command, flags);
    const auto parse_spp = [](const std::string &text) {
        return static_cast<std::uint32_t>(parse_count(text, spp_range));
    };
    add_parsed(command, "--spp", flags.spp, parse_spp,
               "Samples per pixel of the reference; a square for grid, even for mis (default " +
                   std::to_string(flags.spp) + ")")
        ->type_name("N");
    add_choice(command, "--sampler", flags.sampler, samplers,
               std::string("Sampler of the reference (default ") + word_for(flags.sampler, samplers) + ")");
    const auto parse_error = [](const std::string &text) { return parse_number(text, target_error_range); };
    const std::string default_error = flags.target_error > 0.0 ? " (default " + general(flags.target_error) + ")" : "";
    add_parsed(
        command, "--target-error", flags.target_error, parse_error,
        "Instead of --spp: as many samples as bring the reference's standard error, relative to the image, below E" +
            default_error)
        ->type_name("E");
    add_choice(command, "--scrambles", flags.scrambles, scramble_counts,
               "Independent scrambles of the reference's samples, from which its standard error is: more make it more "
               "honest, and the samples less even (default 8)");
    add_seed_flag(command, flags);
    add_device_flags(command, flags);
}

void add_grade_flag(CLI::App &command, RenderFlags &flags) {
    add_choice(command, "--grade", flags.grade, grades,
               "Arithmetic: float to about 1e-4, float to its precision, or double for checking (default precise)");
}

void add_render_flags(CLI::App &command, RenderFlags &flags) {
    add_sampling_flags(command, flags);
    add_choice(command, "--lookup", flags.lookup, lookups, "Table lookup of the reference (default linear)");
    add_masking_flag(command, flags);
    add_grade_flag(command, flags);
}

std::int32_t parse_widening_order(const std::string &text) {
    return text == "auto" ? SMX_WIDENING_AUTO : static_cast<std::int32_t>(parse_count(text, order_range));
}

std::string widening_text(std::int32_t order) { return order == SMX_WIDENING_AUTO ? "auto" : std::to_string(order); }

std::vector<std::uint32_t> parse_lobe_counts(const std::string &text) {
    std::vector<std::uint32_t> lobes = parse_counts(text, lobes_range);
    require_distinct(text, lobes, [](std::uint32_t count) { return std::to_string(count); });
    return lobes;
}

std::vector<std::int32_t> parse_widening_orders(const std::string &text) {
    std::vector<std::int32_t> orders;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) orders.push_back(parse_widening_order(word));
    if (orders.empty() || text.back() == ',') throw std::invalid_argument("'" + text + "' is not a list of orders");
    require_distinct(text, orders, widening_text);
    return orders;
}

void add_widening_tolerance(CLI::App &command, RenderFlags &flags) {
    const auto parse_tolerance = [](const std::string &text) { return parse_number(text, tolerance_range); };
    add_parsed(command, "--widening-tolerance", flags.widening_tolerance, parse_tolerance,
               "relRMSE that --widening-order auto may leave (default 0.02)")
        ->type_name("E");
}

void note_tolerance_without_effect(const CLI::App &command, bool is_auto) {
    if (!is_auto && command.count("--widening-tolerance") > 0)
        std::cerr << "slopemix: note: --widening-tolerance has no effect without --widening-order auto\n";
}

void add_widening_flags(CLI::App &command, RenderFlags &flags) {
    add_parsed(command, "--widening-order", flags.widening_order, parse_widening_order,
               "How the displaced surface widens a lobe in filtered images: 0 in closed form, 1 to 8 by quadrature of "
               "that order, auto by the least that will do (default 0)")
        ->type_name("N");
    add_widening_tolerance(command, flags);
}

std::string sampling_text(const RenderFlags &flags) {
    if (flags.target_error > 0.0) return "standard error " + general(flags.target_error, 3);
    return std::to_string(flags.spp) + " samples per pixel";
}

void require_legal_sampling(const RenderFlags &flags) {
    if (flags.target_error > 0.0) {
        if (flags.sampler == SMX_SAMPLER_GRID)
            throw CLI::ValidationError("--target-error", "the grid has no estimate of its error; use sobol or mis");
        return;
    }
    const auto refuse = [&](const std::string &demand) {
        throw CLI::ValidationError("--spp", "'" + std::to_string(flags.spp) + "' is not " + demand);
    };
    if (flags.sampler == SMX_SAMPLER_GRID && !is_square(flags.spp))
        refuse("a square such as 4096 or 65536, which the grid needs");
    if (flags.sampler == SMX_SAMPLER_MIS && flags.spp % 2 != 0) refuse("even, which mis needs");
}

void require_estimate(const RenderFlags &flags) {
    if (flags.sampler == SMX_SAMPLER_GRID)
        throw CLI::ValidationError("--errors", "the grid has no estimate of its error; use sobol or mis");
    const std::uint32_t step = 2 * flags.scrambles;
    if (flags.target_error == 0.0 && flags.spp % step != 0)
        throw CLI::ValidationError("--spp", "'" + std::to_string(flags.spp) + "' is not a multiple of " +
                                                std::to_string(step) + ", which --errors needs");
}

} // namespace slopemix::cli
