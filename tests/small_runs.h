// Commands that fill a folder with their results in a second or so.
#pragma once

#include <string>
#include <vector>

#include "files.h"

namespace test {

using Command = std::vector<std::string> (*)(const TempDir &out);

// Two materials, one after the other.
inline std::vector<std::string> small_fit(const TempDir &out) {
    return {"fit",
            "analytic:ggx,alpha=0.2,f0=0.5",
            "analytic:lambert,albedo=0.5",
            "--model",
            "shared",
            "--lobes",
            "2",
            "--jobs",
            "1",
            "--out",
            out.path()};
}

inline std::vector<std::string> small_sheet(const TempDir &out) {
    return {"sheet", "builtin:conductor", "--res", "24",    "--spp",    "64",      "--radii",
            "0.1",   "--lobes",           "1",     "--out", out.path(), "--resume"};
}

inline std::vector<std::string> small_tradeoff(const TempDir &out) {
    return {"tradeoff",  "builtin:conductor", "--res",   "16", "--samples",        "64",
            "--methods", "mis,shared",        "--lobes", "1",  "--widening-order", "0",
            "--out",     out.path(),          "--resume"};
}

} // namespace test
