// The 100 materials of the MERL database as the supplemental document numbers them.
#pragma once

#include <span>

namespace slopemix::cli {

struct MerlMaterial {
    int number;       // the document's, alphabetical
    const char *name; // of its table, NAME.binary, as MERL spells it
    bool listed;      // printed in the document; its numbering leaves the others' places
    const char *kind; // ours, by the name
};

std::span<const MerlMaterial> merl_catalogue();

} // namespace slopemix::cli
