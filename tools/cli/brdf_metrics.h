// The figures of smx_brdf_errors by name, with the difference that each is the root mean square of.
#pragma once

#include "slopemix.h"

namespace slopemix::cli {

struct BrdfMetric {
    const char *name;    // in tables and JSON; with "_80" up to 80 degrees
    const char *formula; // for people
    double smx_brdf_errors::*all;
    double smx_brdf_errors::*within_80;
};

inline constexpr BrdfMetric brdf_metrics[] = {
    {"l2", "(f - r) cos_i", &smx_brdf_errors::l2, &smx_brdf_errors::l2_80},
    {"log", "ln(1 + f cos_i) - ln(1 + r cos_i)", &smx_brdf_errors::log, &smx_brdf_errors::log_80},
    {"cube_root", "(f cos_i)^(1/3) - (r cos_i)^(1/3)", &smx_brdf_errors::cube_root, &smx_brdf_errors::cube_root_80}};

inline constexpr const char *brdf_metrics_note =
    "Root mean squares over the pairs of directions by solid angle and over the channels; docs/metrics.md";

} // namespace slopemix::cli
