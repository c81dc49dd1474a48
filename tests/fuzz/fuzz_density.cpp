// smx_density_read_csv: a density that is read is normalised and finite.
#include <cmath>

#include "memory.h"
#include "target.h"

namespace {

// Of the file's length: a row of four bytes becomes a node of some doubles.
constexpr std::size_t length_factor = 100;

void require_sound(smx_density density) {
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    fuzz::require_ok(smx_density_get_info(density, &info), "facts about a density");
    std::vector<double> slope(info.nodes), p22(info.nodes), mass(info.nodes);
    fuzz::require_ok(smx_density_get_nodes(density, slope.data(), p22.data(), mass.data(), info.nodes), "its nodes");
    double sum = 0.0;
    for (std::size_t k = 0; k < info.nodes; ++k) {
        fuzz::require(std::isfinite(slope[k]) && std::isfinite(p22[k]) && p22[k] >= 0.0 && mass[k] >= 0.0, "a node");
        sum += mass[k];
    }
    fuzz::require(std::abs(sum - 1.0) < 1e-9 && std::isfinite(info.alpha), "a density's sum");
}

} // namespace

std::vector<std::string> fuzz::seeds() {
    return {"theta,ndf\n0,3.5\n0.2,1.6\n0.5,0.1\n1.5,0\n",
            "\xEF\xBB\xBF# a comment\r\ntheta,p22\r\n 0 , 1e30 \r\n1e-300,1e-300\r\n",
            "theta,value\n0,0\n1.5707963,1\n",
            "0,1\n0.1,nan\n",
            "0,1\n0.1,1e999\n0.05,1\n",
            "0,1,2\n",
            "0;1\n"};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static fuzz::MemoryFile file;
    file.set(data, size);
    smx_density density = nullptr;
    smx_status status;
    {
        const fuzz::MemoryLimit limit(length_factor * size + fuzz::always_legal);
        status = smx_density_read_csv(file.path().c_str(), &density);
    }
    fuzz::require_outcome(status, density, {SMX_BAD_FORMAT, SMX_NO_SOLUTION});
    if (density) require_sound(density);
    smx_density_release(density);
    return 0;
}
