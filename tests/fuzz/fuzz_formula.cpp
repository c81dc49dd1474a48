// smx_brdf_open on words: built-in materials and formulas, as the command line takes them.
#include "memory.h"
#include "target.h"

namespace {

constexpr std::size_t table_bytes = std::size_t{3} * 8 * 90 * 90 * 180; // what every formula declares
constexpr std::size_t table_factor = 3;                                 // as of a table that is read

} // namespace

std::vector<std::string> fuzz::seeds() {
    return {"builtin:none",
            "analytic:ggx,alpha=0.2,f0=0.9/0.6/0.5",
            "analytic:beckmann,alpha=1e-3,f0=0",
            "analytic:blinn-phong,exponent=1e6,f0=1",
            "analytic:lambert,albedo=0.5",
            "analytic:lambert,albedo=1e999",
            "analytic:ggx,alpha=,f0==,alpha=1"};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const std::string words(reinterpret_cast<const char *>(data), size);
    if (!words.starts_with("analytic:") && !words.starts_with("builtin:")) return 0; // a file's name
    smx_brdf brdf = nullptr;
    smx_status status;
    {
        const fuzz::MemoryLimit limit(table_factor * table_bytes + fuzz::always_legal);
        status = smx_brdf_open(words.c_str(), &brdf);
    }
    fuzz::require_outcome(status, brdf, {SMX_INVALID_ARGUMENT});
    smx_brdf_release(brdf);
    return 0;
}
