#include "fit_compare.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "handles.h"
#include "input.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

void print_json(const std::string &other, const std::string &source, const smx_brdf_errors &e) {
    const Json document = {{"version", SMX_VERSION_STRING},
                           {"input", source},
                           {"compare", other},
                           {"l2", e.l2},
                           {"log", e.log},
                           {"cube_root", e.cube_root},
                           {"l2_80", e.l2_80},
                           {"log_80", e.log_80},
                           {"cube_root_80", e.cube_root_80}};
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_text(const smx_brdf_errors &e) {
    print_table(std::cout, {{"", "all directions", "up to 80 degrees"},
                            {"(f - r) cos_i", general(e.l2), general(e.l2_80)},
                            {"ln(1 + f cos_i) - ln(1 + r cos_i)", general(e.log), general(e.log_80)},
                            {"(f cos_i)^(1/3) - (r cos_i)^(1/3)", general(e.cube_root), general(e.cube_root_80)}});
    std::cout
        << "Root mean squares over the pairs of directions by solid angle and over the channels; docs/metrics.md\n";
}

} // namespace

void compare_tables(const std::string &other, const std::string &source, bool json) {
    const Brdf reference = open_brdf(source), brdf = open_brdf(other);
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    check(smx_brdf_compare(brdf.get(), reference.get(), &errors));
    if (json)
        print_json(other, source, errors);
    else
        print_text(errors);
}

} // namespace slopemix::cli
