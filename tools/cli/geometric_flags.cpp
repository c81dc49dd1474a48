#include "geometric_flags.h"

#include <bit>
#include <string>

#include "flags.h"

namespace slopemix::cli {

namespace {

constexpr CountRange tile_range = {64, 8192}, realisations_range = {1, 65536}, bounces_range = {0, 1024};

std::uint32_t parse_tile(const std::string &text) {
    const auto tile = static_cast<std::uint32_t>(parse_count(text, tile_range));
    if (!std::has_single_bit(tile)) throw std::invalid_argument("'" + text + "' is not a power of two");
    return tile;
}

} // namespace

void add_geometric_flags(CLI::App &command, GeometricFlags &flags) {
    const auto count_in = [](CountRange range) {
        return [range](const std::string &text) { return static_cast<std::uint32_t>(parse_count(text, range)); };
    };
    add_parsed(command, "--bounces", flags.bounces, count_in(bounces_range),
               "Geometric: facets after the first one seen that light may have met, 0 to 1024 (default 0)")
        ->type_name("K");
    add_parsed(command, "--tile", flags.tile, parse_tile,
               "Geometric: cells along a side of the tile, a power of two, 64 to 8192 (default 1024)")
        ->type_name("N");
    add_parsed(command, "--realisations", flags.realisations, count_in(realisations_range),
               "Geometric: independent tiles, which share the samples (default 16)")
        ->type_name("R");
}

void require_legal_realisations(const GeometricFlags &flags, std::uint32_t spp, bool errors) {
    if (spp % flags.realisations != 0)
        throw CLI::ValidationError("--spp", "'" + std::to_string(spp) + "' is not a multiple of --realisations, " +
                                                std::to_string(flags.realisations));
    if (errors && flags.realisations == 1)
        throw CLI::ValidationError("--errors", "one realisation has no estimate of its error; use 2 or more");
}

} // namespace slopemix::cli
