#include "sample_to_target.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "sampling_plan.h"

namespace smx {

namespace {

// Samples for the next try, from the error of the last one. Scrambled Sobol points were measured to converge as their
// number to the -0.75 on these integrands; a tenth more, so that chance does not ask for another round; a power of two,
// as Sobol's points like it.
std::uint32_t next_spp(std::uint32_t spp, double error, double target) {
    const double wanted = spp * 1.1 * std::pow(error / target, 1.0 / 0.75);
    std::uint32_t next = 2 * spp;
    while (next < wanted && next < max_spp) next *= 2;
    return next;
}

} // namespace

RenderReport sample_to_target(const RenderOptions &options, std::uint64_t lit,
                              const std::function<Attempt(std::uint32_t spp)> &attempt) {
    const std::uint32_t first_try = 8 * options.scrambles;
    const bool to_target = options.target_error > 0.0;
    RenderReport report;
    for (std::uint32_t spp = to_target ? first_try : options.spp;;) {
        const Attempt tried = attempt(spp);
        report.spp = tried.samples;
        report.standard_error = tried.standard_error;
        report.kernel_seconds += tried.kernel_seconds;
        report.evaluations += lit * report.spp;
        if (std::isnan(report.standard_error)) fail(Fault::Internal, "the standard error is no number");
        if (!to_target || report.standard_error <= options.target_error || spp >= options.most_spp) return report;
        spp = std::min(next_spp(spp, report.standard_error, options.target_error), options.most_spp);
    }
}

} // namespace smx
