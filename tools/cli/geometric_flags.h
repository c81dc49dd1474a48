// The flags of the geometric reference.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

#include "slopemix.h"

namespace slopemix::cli {

struct GeometricFlags {
    std::uint32_t tile = 1024, realisations = 16, bounces = 0;

    smx_geometric_options options() const {
        smx_geometric_options options = SMX_GEOMETRIC_OPTIONS_INIT;
        options.tile = tile;
        options.realisations = realisations;
        options.bounces = bounces;
        return options;
    }
};

// A sample costs it about a hundred times what the statistical reference's does.
inline constexpr std::uint32_t geometric_spp = 4096;

void add_geometric_flags(CLI::App &command, GeometricFlags &flags);

// Throws CLI::ValidationError where the samples cannot be shared out, or one realisation has no error to tell.
void require_legal_realisations(const GeometricFlags &flags, std::uint32_t spp, bool errors);

} // namespace slopemix::cli
