// The command line: an input is the arguments, one a line. Where the first one names a command, the whole line is
// parsed as the command's, which then does not run. Else they are flags whose values are looked at: what the parser
// takes is in the ranges that the API demands. What it does not take is one of its errors, and nothing else is thrown.
#include <algorithm>
#include <bit>

#include "choose.h"
#include "commands.h"
#include "effect_flags.h"
#include "geometric_flags.h"
#include "memory.h"
#include "scene_flags.h"
#include "target.h"

using namespace slopemix::cli;

namespace {

constexpr std::size_t parser = std::size_t{1} << 20; // a command's flags, their checks and what they say
constexpr std::size_t length_factor = 100;           // a line of no character is a text and a result of the parser

using Arguments = std::vector<std::string>;

struct Values {
    FitFlags fit;
    RenderFlags render;
    SceneFlags scene;
    GeometricFlags geometric;
    ChooseFlags choose;
    std::string integrator;
    std::vector<double> radii{0.1};
    std::vector<std::uint32_t> counts{8}, lobe_counts;
    std::vector<std::int32_t> orders;
    std::vector<ImageId> only;
};

void add_list_flags(CLI::App &command, Values &values) {
    add_parsed(
        command, "--radii", values.radii, [](const std::string &t) { return parse_numbers(t, alpha_range); }, "");
    add_parsed(
        command, "--counts", values.counts, [](const std::string &t) { return parse_counts(t, lobes_range); }, "");
    add_parsed(command, "--lobe-counts", values.lobe_counts, parse_lobe_counts, "");
    add_parsed(command, "--orders", values.orders, parse_widening_orders, "");
    add_parsed(
        command, "--only", values.only, [](const std::string &t) { return parse_image_ids(t); }, "");
}

void add_flags(CLI::App &command, Values &values) {
    add_surface_flags(command, values.scene);
    add_light_flag(command, values.scene, true);
    add_fit_flags(command, values.fit);
    add_render_flags(command, values.render);
    add_widening_flags(command, values.render);
    add_effect_flags(command, values.render);
    add_geometric_flags(command, values.geometric);
    command.add_option("--integrator", values.integrator);
    add_choose_flags(command, values.choose);
    add_list_flags(command, values);
    for (const char *flag : {"--alpha", "--light"}) command.get_option(flag)->required(false);
}

// Not a number is in no range.
void require_in(double value, double low, double high, const char *what) {
    fuzz::require(value >= low && value <= high, what);
}

void require_alpha(double alpha) { require_in(alpha, 0.0, 1e4, "a legal alpha"); }

void require_order(std::int32_t order) {
    require_in(order, SMX_WIDENING_AUTO, SMX_WIDENING_MAX_ORDER, "a legal order");
}

void require_lobes(std::uint32_t lobes) { require_in(lobes, 1, SMX_MAX_LOBES, "legal lobes"); }

void require_legal(const SceneFlags &scene) {
    const smx_displacement surface = scene.displacement();
    require_alpha(surface.alpha_x);
    require_alpha(surface.alpha_y);
    fuzz::require(surface.rho > -1.0 && surface.rho < 1.0, "a legal correlation");
    require_in(surface.mean_slope_x, -1e4, 1e4, "a legal mean slope");
    require_in(surface.mean_slope_y, -1e4, 1e4, "a legal mean slope");
    require_in(scene.light_degrees, -1e6, 1e6, "a legal light");
}

void require_legal(const RenderFlags &render) {
    require_in(render.resolution.width, 1, 16384, "a legal width");
    require_in(render.resolution.height, 1, 16384, "a legal height");
    require_in(render.spp, 1, 1u << 24, "a legal number of samples");
    fuzz::require(render.target_error >= 0.0 && render.target_error < 1.0, "a legal target");
    fuzz::require(std::has_single_bit(render.scrambles) && render.scrambles >= 8 && render.scrambles <= 64,
                  "legal scrambles");
    require_order(render.widening_order);
    require_in(render.widening_tolerance, 1e-6, 0.5, "a legal tolerance of the order");
    const bool is_rule = render.effects == SMX_EFFECTS_AUTO || render.effects == SMX_EFFECTS_ALL;
    fuzz::require(is_rule || render.effects < 1u << SMX_EFFECT_COUNT, "legal effects");
    require_in(render.effect_tolerance, 0.0, 0.5, "a legal tolerance of the effects");
    require_in(render.sub_devices, 0, 1u << 16, "a legal number of sub-devices");
}

void require_legal(const GeometricFlags &geometric) {
    require_in(geometric.tile, 64, 8192, "a legal tile");
    fuzz::require(std::has_single_bit(geometric.tile), "a tile whose side is a power of two");
    require_in(geometric.realisations, 1, 65536, "legal realisations");
    require_in(geometric.bounces, 0, 1024, "legal bounces");
}

void require_legal(const ChooseFlags &choose) {
    if (choose.max_error != 0.0) require_in(choose.max_error, 1e-5, 1.0, "a legal error");
    if (choose.max_seconds != 0.0) require_in(choose.max_seconds, 1e-9, 1e9, "a legal time");
    fuzz::require(choose.max_error == 0.0 || choose.max_seconds == 0.0, "an error or a time");
}

void require_legal(const Values &values) {
    require_legal(values.scene);
    require_legal(values.render);
    require_legal(values.geometric);
    require_legal(values.choose);
    if (values.fit.lobes != SMX_LOBES_AUTO) require_lobes(values.fit.lobes);
    for (const double radius : values.radii) require_alpha(radius);
    for (const std::uint32_t count : values.counts) require_lobes(count);
    for (const std::uint32_t count : values.lobe_counts) require_lobes(count);
    for (const std::int32_t order : values.orders) require_order(order);
    for (const ImageId &id : values.only)
        fuzz::require(id.table >= 1 && id.row >= 1 && id.column >= 1 && parse_image_ids(to_string(id)).size() == 1,
                      "a legal image");
}

void parse_flags(const Arguments &reversed) {
    CLI::App command("fuzz", "fuzz");
    Values values;
    add_flags(command, values);
    command.parse(Arguments(reversed));
    require_legal(values);
    require_legal_sampling(values.render);
    require_legal_realisations(values.geometric, values.render.spp, true);
    require_consistent_effects(command, values.render);
}

// The real commands, which end where they would begin to work.
CLI::App &commands() {
    static const std::unique_ptr<CLI::App> app = [] {
        std::unique_ptr<CLI::App> made = make_app();
        made->parse_complete_callback([] { throw CLI::Success(); });
        return made;
    }();
    return *app;
}

bool names_command(const std::string &word) {
    const std::vector<CLI::App *> all = commands().get_subcommands({});
    return std::any_of(all.begin(), all.end(), [&](const CLI::App *command) { return command->get_name() == word; });
}

Arguments lines_of(const uint8_t *data, std::size_t size) {
    Arguments lines{""};
    for (std::size_t k = 0; k < size; ++k) {
        if (data[k] == '\n')
            lines.emplace_back();
        else
            lines.back() += static_cast<char>(data[k]);
    }
    return lines;
}

} // namespace

std::vector<std::string> fuzz::seeds() {
    return {
        "--res\n128x64\n--spp\n4096\n--sampler\nmis\n--seed\n18446744073709551615\n--scrambles\n16",
        "--alpha\n0.25,1e-3\n--radii\n0.1,+0.25,5e-1\n--only\n1.1.1,3.3.10\n--rho\n-0.999\n--mean-slope\n-1e4,0.5",
        "--lobes\nauto\n--model\nper-lobe\n--counts\n1,64\n--lobe-counts\n8,1\n--orders\n0,auto,8",
        "--target-error=1e-6\n--widening-order=auto\n--widening-tolerance=0.5\n--grade\nfast\n--light\nuniform",
        "--lookup\nnearest\n--g\nseparable\n--device\n0,pocl\n--sub-devices\n65536\n--light\n-25",
        "--effects\nmasking,shadowing\n--effect-tolerance\n0\n--tile\n64\n--bounces\n1024\n--realisations\n65536",
        "--max-error\n1e-5\n--material\na.json\n--material\nb.json",
        "--max-seconds\n1e9\n--effects\nauto",
        "--res\n0x16385\n--alpha\nnan,inf\n--spp\n-1\n--rho\n1\n--tile\n65\n--effects\nall,",
        "render\nbuiltin:mirror\n--integrator\ngeometric\n--alpha\n0,0\n--light\n0\n--out\nx.exr\n--errors\n--png",
        "fit\na.binary\nb.binary\n--jobs\n256\n--lobes\n64\n--model\nshared\n--out\nd\n--metrics\n--plot\n--resume",
        "fit\na.binary\n--compare\nb.binary\n--json",
        "sheet\na.binary\n--out\nd\n--radii\n0,1e4\n--model\nboth\n--widening-order\n0,auto\n--fit\nf\n--only\n1.1.1",
        "tradeoff\na.binary\n--out\nd\n--methods\nmis,shared,per-lobe\n--samples\n65536\n--quick\n--lobes\n1,64",
        "budget\na.binary\n--alpha\n0,0\n--alpha\n0.5,0.1\n--light\n-25\n--lobes\n8\n--grade\ndouble",
        "effects\nm.json\n--alpha\n0.1,0.1\n--light\n90\n--effect-tolerance\n0.5",
        "compare\na.exr\nb.exr\n--json",
        "bench\n--device\n0\n--quick",
        "synth\nanalytic:lambert,albedo=1\n--out\nt.binary",
        "materials\nmerl\n--json",
        "info\n--json"};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    Arguments arguments = lines_of(data, size);
    const bool is_command = names_command(arguments.front());
    const fuzz::MemoryLimit limit(length_factor * size + parser);
    std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes them
    try {
        if (is_command)
            commands().parse(std::move(arguments));
        else
            parse_flags(arguments);
    } catch (const CLI::Error &) {
    }
    return 0;
}
