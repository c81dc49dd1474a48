// slopemix compare: errors of one image against another.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.h"
#include "handles.h"
#include "text.h"

namespace slopemix::cli {

namespace {

struct CompareFlags {
    std::string image, reference;
    bool json = false;
};

// JSON knows no infinity; an infinite error or bias is written as null.
void print_json(const CompareFlags &flags, const smx_comparison &errors) {
    const nlohmann::ordered_json document = {{"version", SMX_VERSION_STRING}, {"image", flags.image},
                                             {"reference", flags.reference},  {"relrmse", errors.relrmse},
                                             {"rmse", errors.rmse},           {"max_error", errors.max_error},
                                             {"bias", errors.bias},           {"pixels", errors.pixels}};
    std::cout << document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

void print_text(const smx_comparison &errors) {
    print_facts(std::cout, {{"relRMSE", general(errors.relrmse)},
                            {"RMSE", general(errors.rmse)},
                            {"max error", general(errors.max_error)},
                            {"bias", general(errors.bias)},
                            {"pixels", std::to_string(errors.pixels)}});
}

void run(const CompareFlags &flags) {
    const Image image = acquire<Image>(smx_image_read_exr, flags.image.c_str());
    const Image reference = acquire<Image>(smx_image_read_exr, flags.reference.c_str());
    smx_comparison errors = SMX_COMPARISON_INIT;
    check(smx_image_compare(image.get(), reference.get(), &errors));
    if (flags.json)
        print_json(flags, errors);
    else
        print_text(errors);
}

} // namespace

void add_compare(CLI::App &app) {
    CLI::App *command = app.add_subcommand("compare", "Errors of one image against another");
    const auto flags = std::make_shared<CompareFlags>();
    command->add_option("A", flags->image, "The image, an EXR file")->required()->type_name("");
    command->add_option("B", flags->reference, "The reference, an EXR file")->required()->type_name("");
    command->add_flag("--json", flags->json, "Print JSON; an infinite value is null");
    command->footer(
        "Over the pixels on the reference's surface (alpha > 0 in B) and the three channels:\n"
        "relRMSE = sqrt(mean (A-B)^2) / sqrt(mean B^2), RMSE = sqrt(mean (A-B)^2), max error = the largest |A-B|,\n"
        "bias = mean A / mean B.");
    command->callback([flags] { run(*flags); });
}

} // namespace slopemix::cli
