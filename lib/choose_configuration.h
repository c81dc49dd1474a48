// The cheapest way to make an image whose error is at most E, or the most accurate within T seconds (docs/choosing.md).
// Configurations are tried on a pilot: some pixels of the image itself, where more samples than they need say what is
// true.
#pragma once

#include <string>
#include <vector>

#include "configuration.h"
#include "integrate_reference.h"

namespace smx {

struct ChoiceRequest {
    double max_error = 0.0, max_seconds = 0.0; // one of them above 0
    std::uint32_t pilot_pixels = 512;
};

// Throws InvalidArgument, naming value and range.
void validate(const ChoiceRequest &request);

struct Choice {
    Configuration picked;
    std::optional<Configuration> cheaper; // of those tried that cost less, the one of the least error
    std::optional<Configuration> better;  // of those tried or extrapolated that are more accurate, the cheapest
    std::vector<Configuration> tried;     // in the order in which they were
    std::string reason;
    std::size_t pilot_pixels = 0;
    double pilot_error = -1.0; // standard error of what the pilot takes for true; negative: without a table
    double device_speed = 1.0; // seconds here over those of the constants' device
    RenderReport cost;         // of the choice: times only
};

// A table to choose a reference of; it may be absent, and the materials' fit reports then say how far they are from it.
struct ChoiceTable {
    const Brdf &brdf;
    ProposalSource proposal;
};

// Of the options, the seed, the lookup, the grade and the progress count. Throws NoSolution where no configuration
// will do, and says which comes nearest.
Choice choose_configuration(Context &context, const std::optional<ChoiceTable> &table,
                            const std::vector<const Material *> &materials, const Scene &scene,
                            const RenderOptions &options, const ChoiceRequest &request);

} // namespace smx
