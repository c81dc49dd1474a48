#include "choose.h"

#include <chrono>

#include "input.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr NumberRange error_range = {1e-5, 1.0};
constexpr NumberRange seconds_range = {1e-9, 1e9};

// Few lobes are cheap, and eight are what the fit is at its best by; each model fits some materials better.
constexpr std::uint32_t fitted_lobes[] = {1, 8};

std::vector<FitFlags> fits_to_make(const FitFlags &given, bool lobes_given) {
    std::vector<FitFlags> fits;
    for (const auto &model : models)
        for (const std::uint32_t lobes : fitted_lobes) {
            const bool is_repeated = lobes_given && lobes != fitted_lobes[0];
            if (is_repeated || (given.model_given && model.value != given.model)) continue;
            fits.push_back(given);
            fits.back().model = model.value;
            if (!lobes_given) fits.back().lobes = lobes;
        }
    return fits;
}

Material load(const std::string &file) { return acquire<Material>(smx_material_load, file.c_str()); }

Json configuration_json(const smx_configuration &c, const std::vector<smx_material_info> &materials) {
    const bool is_filtered = c.material != SMX_BY_REFERENCE;
    const smx_material_info *info = is_filtered ? &materials[static_cast<std::size_t>(c.material)] : nullptr;
    return {{"integrator", is_filtered ? "filtered" : "reference"},
            {"material", info ? Json(c.material) : Json()},
            {"model", info ? Json(word_for(info->model, models)) : Json()},
            {"lobes", info ? Json(info->lobes) : Json()},
            {"widening_order", info ? Json(c.widening_order) : Json()},
            {"sampler", info ? Json() : Json(word_for(c.sampler, samplers))},
            {"spp", info ? Json() : Json(c.spp)},
            {"error", c.error},
            {"seconds", c.seconds}};
}

std::string configuration_text(const smx_configuration &c, const std::vector<smx_material_info> &materials) {
    std::string text;
    if (c.material == SMX_BY_REFERENCE) {
        text = std::string("reference, ") + word_for(c.sampler, samplers) + ", " + std::to_string(c.spp) +
               " samples per pixel";
    } else {
        const smx_material_info &info = materials[static_cast<std::size_t>(c.material)];
        text = std::string("filtered, ") + word_for(info.model, models) + ", lobes: " + std::to_string(info.lobes) +
               ", widening order " + std::to_string(c.widening_order);
    }
    return text + ": error " + general(c.error, 3) + ", " + general(c.seconds, 3) + " s";
}

} // namespace

void add_choose_flags(CLI::App &command, ChooseFlags &flags) {
    const auto parse_error = [](const std::string &text) { return parse_number(text, error_range); };
    const auto parse_seconds = [](const std::string &text) { return parse_number(text, seconds_range); };
    CLI::Option *error = add_parsed(command, "--max-error", flags.max_error, parse_error,
                                    "Choose the cheapest way whose error, relRMSE against the converged reference, is "
                                    "predicted to be at most E")
                             ->type_name("E");
    CLI::Option *seconds = add_parsed(command, "--max-seconds", flags.max_seconds, parse_seconds,
                                      "Choose the most accurate way whose time on the device is predicted to be at "
                                      "most T")
                               ->type_name("T")
                               ->excludes(error);
    command
        .add_option("--material", flags.materials,
                    "A fit to choose from, any number of times, in place of those that are made (--max-error, "
                    "--max-seconds)")
        ->allow_extra_args(false)
        ->type_name("FILE.json");
    for (const char *answered :
         {"--integrator", "--spp", "--target-error", "--sampler", "--widening-order", "--widening-tolerance"})
        for (CLI::Option *flag : {error, seconds}) flag->excludes(command.get_option(answered));
}

Candidates open_candidates(const std::string &input, const ChooseFlags &flags, const FitFlags &fit_flags,
                           bool lobes_given) {
    Candidates candidates;
    if (is_material_file(input))
        candidates.materials.push_back(load(input));
    else
        candidates.brdf = open_brdf(input);
    for (const std::string &file : flags.materials) candidates.materials.push_back(load(file));
    if (!candidates.materials.empty()) return candidates;

    const auto begin = std::chrono::steady_clock::now();
    const Density density = invert(candidates.brdf);
    for (const FitFlags &fit_to_make : fits_to_make(fit_flags, lobes_given))
        candidates.materials.push_back(fit(density, fit_to_make));
    candidates.fit_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return candidates;
}

Chosen choose(const Context &context, const Candidates &candidates, const smx_scene &scene,
              const smx_render_options &options, const ChooseFlags &flags) {
    smx_choose_options asked = SMX_CHOOSE_OPTIONS_INIT;
    asked.max_error = flags.max_error;
    asked.max_seconds = flags.max_seconds;
    std::vector<smx_material> handles;
    Chosen chosen;
    for (const Material &material : candidates.materials) {
        handles.push_back(material.get());
        chosen.materials.push_back(info_of(material));
    }
    chosen.fit_seconds = candidates.fit_seconds;
    check(smx_choose(context.get(), candidates.brdf.get(), handles.data(), handles.size(), &scene, &options, &asked,
                     &chosen.choice));
    return chosen;
}

Json choice_json(const Chosen &chosen, const ChooseFlags &flags) {
    const smx_choice &choice = chosen.choice;
    const auto json = [&](const smx_configuration &c) { return configuration_json(c, chosen.materials); };
    Json tried = Json::array();
    for (std::uint32_t k = 0; k < choice.tried_count; ++k) tried.push_back(json(choice.tried[k]));
    return {{"max_error", flags.max_error > 0.0 ? Json(flags.max_error) : Json()},
            {"max_seconds", flags.max_seconds > 0.0 ? Json(flags.max_seconds) : Json()},
            {"reason", choice.reason},
            {"picked", json(choice.picked)},
            {"cheaper", choice.has_cheaper ? json(choice.cheaper) : Json()},
            {"better", choice.has_better ? json(choice.better) : Json()},
            {"tried", tried},
            {"pilot_pixels", choice.pilot_pixels},
            {"pilot_error", choice.pilot_error >= 0.0 ? Json(choice.pilot_error) : Json()},
            {"device_speed", choice.device_speed},
            {"seconds", choice.seconds},
            {"kernel_seconds", choice.kernel_seconds},
            {"build_seconds", choice.build_seconds},
            {"fit_seconds", chosen.fit_seconds}};
}

Facts choice_facts(const Chosen &chosen) {
    const smx_choice &choice = chosen.choice;
    Facts facts = {{"picked", configuration_text(choice.picked, chosen.materials) + ", as predicted"}};
    if (choice.has_cheaper) facts.emplace_back("next cheaper", configuration_text(choice.cheaper, chosen.materials));
    if (choice.has_better) facts.emplace_back("next better", configuration_text(choice.better, chosen.materials));
    facts.emplace_back("choice", std::to_string(choice.tried_count) + " ways tried on " +
                                     std::to_string(choice.pilot_pixels) + " pixels in " + fixed(choice.seconds, 3) +
                                     " s (on the device " + fixed(choice.kernel_seconds, 3) + ", compiling kernels " +
                                     fixed(choice.build_seconds, 3) + "), fits " + fixed(chosen.fit_seconds, 3) + " s");
    return facts;
}

} // namespace slopemix::cli
