// Sums of Beckmann lobes with height-correlated Smith masking and Schlick's Fresnel curve.
#include "builtin.h"

#include "error.h"
#include "microfacet.h"
#include "table_sampling.h"

namespace smx {

namespace {

Rgb two_layer(const Cosines &at) {
    constexpr double gloss_alpha = 0.06, gloss_f0 = 0.04, body_alpha = 0.6;
    constexpr Rgb body = {0.55, 0.10, 0.04};
    const double gloss = schlick(at.d, gloss_f0);
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c)
        f[c] = gloss * beckmann_lobe(at, gloss_alpha) + (1.0 - gloss) * body[c] * beckmann_lobe(at, body_alpha);
    return f;
}

Rgb conductor(const Cosines &at) {
    constexpr double alpha = 0.2;
    constexpr Rgb f0 = {0.95, 0.64, 0.54}; // copper's colour
    Rgb f{};
    for (std::size_t c = 0; c < 3; ++c) f[c] = schlick(at.d, f0[c]) * beckmann_lobe(at, alpha);
    return f;
}

} // namespace

Brdf make_builtin(const std::string &name) {
    const std::string source = std::string(builtin_prefix) + name;
    if (name == "two-layer") return sample_table(name, source, two_layer);
    if (name == "conductor") return sample_table(name, source, conductor);
    fail(Fault::InvalidArgument, "no built-in material \"", name, "\"; there are two-layer and conductor");
}

} // namespace smx
