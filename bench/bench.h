// What the benchmarks share: a context, the built-in material, and a check that stops on failure.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>

#include "slopemix.h"

inline void check(smx_status status) {
    if (status == SMX_OK) return;
    std::fprintf(stderr, "%s: %s\n", smx_status_name(status), smx_last_error());
    std::exit(1);
}

inline smx_context shared_context() {
    static smx_context context = [] {
        smx_context made = nullptr;
        check(smx_context_create(nullptr, &made));
        return made;
    }();
    return context;
}

inline smx_brdf two_layer() {
    static smx_brdf brdf = [] {
        smx_brdf made = nullptr;
        check(smx_brdf_open("builtin:two-layer", &made));
        return made;
    }();
    return brdf;
}
