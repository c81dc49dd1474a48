#include "table_sampling.h"

#include <utility>
#include <vector>

#include "merl_file.h"
#include "sha256.h"

namespace smx {

Brdf sample_table(const std::string &name, const std::string &source, const BrdfFormula &formula) {
    constexpr std::size_t phi_d_count = 180, cells = Brdf::theta_h_count * Brdf::theta_d_count * phi_d_count;
    std::vector<double> values(3 * cells, -1.0);
    for (std::size_t h = 0, cell = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t d = 0; d < Brdf::theta_d_count; ++d)
            for (std::size_t p = 0; p < phi_d_count; ++p, ++cell) {
                const Cosines at = Brdf::cosines(h, d, p);
                if (at.i <= 0.0 || at.o <= 0.0) continue;
                const Rgb f = formula(at);
                for (std::size_t c = 0; c < 3; ++c) values[c * cells + cell] = f[c];
            }
    const std::string hash = sha256_hex(merl_bytes(phi_d_count, values));
    return Brdf(name, source, hash, phi_d_count, std::move(values));
}

} // namespace smx
