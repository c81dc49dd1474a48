// The command line's flags and their values: an input is the arguments, one a line. What the parser takes is in the
// ranges that the API demands; what it does not take is one of its errors, and nothing else is thrown.
#include <cmath>

#include "flags.h"
#include "target.h"

using namespace slopemix::cli;

namespace {

struct Values {
    FitFlags fit;
    RenderFlags render;
    std::pair<double, double> alpha{0.0, 0.0};
    std::vector<double> radii{0.1};
    std::vector<std::uint32_t> lobes{8};
    std::vector<ImageId> only;
};

void add_flags(CLI::App &command, Values &values) {
    add_fit_flags(command, values.fit);
    add_render_flags(command, values.render);
    add_widening_flags(command, values.render);
    add_parsed(
        command, "--alpha", values.alpha, [](const std::string &t) { return parse_pair(t, alpha_range); }, "");
    add_parsed(
        command, "--radii", values.radii, [](const std::string &t) { return parse_numbers(t, alpha_range); }, "");
    add_parsed(
        command, "--counts", values.lobes, [](const std::string &t) { return parse_counts(t, lobes_range); }, "");
    add_parsed(
        command, "--only", values.only, [](const std::string &t) { return parse_image_ids(t); }, "");
}

bool is_alpha(double value) { return value >= alpha_range.low && value <= alpha_range.high; }
bool is_side(std::uint32_t side) { return side >= 1 && side <= 16384; }

void require_legal(const Values &values) {
    const RenderFlags &render = values.render;
    fuzz::require(is_side(render.resolution.width) && is_side(render.resolution.height), "a legal resolution");
    fuzz::require(render.spp >= 1 && render.spp <= 1u << 24, "a legal number of samples");
    fuzz::require(render.target_error >= 0.0 && render.target_error < 1.0, "a legal target");
    fuzz::require(render.widening_order >= SMX_WIDENING_AUTO && render.widening_order <= SMX_WIDENING_MAX_ORDER,
                  "a legal order");
    fuzz::require(is_alpha(values.alpha.first) && is_alpha(values.alpha.second), "legal alphas");
    for (const double radius : values.radii) fuzz::require(is_alpha(radius), "a legal radius");
    for (const std::uint32_t count : values.lobes) fuzz::require(count >= 1 && count <= SMX_MAX_LOBES, "legal lobes");
    for (const ImageId &id : values.only)
        fuzz::require(id.table >= 1 && id.row >= 1 && id.column >= 1 && parse_image_ids(to_string(id)).size() == 1,
                      "a legal image");
}

} // namespace

std::vector<std::string> fuzz::seeds() {
    return {"--res\n128x64\n--spp\n4096\n--sampler\nmis\n--seed\n18446744073709551615",
            "--alpha\n0.25,1e-3\n--radii\n0.1,+0.25,5e-1\n--only\n1.1.1,3.3.10",
            "--lobes\nauto\n--model\nper-lobe\n--counts\n1,64",
            "--target-error=1e-6\n--widening-order=auto\n--widening-tolerance=0.5\n--grade\nfast",
            "--lookup\nnearest\n--g\nseparable\n--device\n0,pocl\n--sub-devices\n65536",
            "--res\n0x16385\n--alpha\nnan,inf\n--spp\n-1"};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    std::vector<std::string> arguments{""};
    for (std::size_t k = 0; k < size; ++k) {
        if (data[k] == '\n')
            arguments.emplace_back();
        else
            arguments.back() += static_cast<char>(data[k]);
    }
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // as CLI11 takes them
    CLI::App command("fuzz", "fuzz");
    Values values;
    add_flags(command, values);
    try {
        command.parse(reversed);
        require_legal(values);
        require_legal_sampling(values.render);
    } catch (const CLI::Error &) {
    }
    return 0;
}
