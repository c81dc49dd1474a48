#include "table_sampling.h"

#include <utility>
#include <vector>

#include "merl_file.h"
#include "sha256.h"

namespace smx {

namespace {

constexpr std::size_t phi_d_count = 180;
constexpr std::size_t cells = Brdf::theta_h_count * Brdf::theta_d_count * phi_d_count;

// phi_d and pi - phi_d are one pair with its directions exchanged. Rounding may put only one of them above the horizon.
void sample_row(std::size_t h, std::size_t d, const TableFormula &formula, double *row) {
    for (std::size_t p = 0; p < phi_d_count; ++p) {
        const Cosines at = Brdf::cosines(h, d, p);
        if (at.i <= 0.0 || at.o <= 0.0) continue;
        const std::size_t exchanged = phi_d_count - p;
        const bool known = exchanged < p && row[exchanged] >= 0.0;
        const Rgb f =
            known ? Rgb{row[exchanged], row[cells + exchanged], row[2 * cells + exchanged]} : formula(h, d, at);
        for (std::size_t c = 0; c < 3; ++c) row[c * cells + p] = f[c];
    }
}

} // namespace

Brdf sample_table(const std::string &name, const std::string &source, const TableFormula &formula) {
    std::vector<double> values(3 * cells, -1.0);
    for (std::size_t h = 0, row = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t d = 0; d < Brdf::theta_d_count; ++d, row += phi_d_count)
            sample_row(h, d, formula, values.data() + row);
    const std::string hash = sha256_hex(merl_bytes(phi_d_count, values));
    return Brdf(name, source, hash, phi_d_count, std::move(values));
}

Brdf sample_table(const std::string &name, const std::string &source, const BrdfFormula &formula) {
    return sample_table(name, source,
                        TableFormula([&](std::size_t, std::size_t, const Cosines &at) { return formula(at); }));
}

} // namespace smx
