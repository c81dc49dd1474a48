#include "fit_material.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "deviations.h"
#include "error.h"
#include "fit_check.h"
#include "fit_data.h"
#include "fit_mixture.h"
#include "fit_per_lobe.h"

namespace smx {

namespace {

constexpr double auto_likelihood_gain = 1e-3; // nat
constexpr double auto_relrmse_gain = 0.005;
constexpr double allowed_worse = 1.02; // than the shared model

// Seconds since it was made, or since it was last read.
class Lap {
  public:
    double read() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A fit and what its deviations are computed from.
struct Candidate {
    Material material;
    FittedCurves curves; // of the per-lobe model
    double seconds = 0.0;
};

Candidate per_lobe_candidate(const FitData &data, const FitOptions &options, const Material &shared,
                             const std::vector<double> &alphas) {
    Lap lap;
    Candidate candidate{shared, {}, 0.0};
    candidate.curves = fit_per_lobe(data, alphas, options.refine, candidate.material);
    candidate.seconds = lap.read();
    return candidate;
}

// The per-lobe model from a shared one, which it must not be worse than.
Candidate make_per_lobe(const FitData &data, const std::vector<DirectionLevel> &check, const FitOptions &options,
                        const Material &shared) {
    std::vector<double> alphas;
    for (const Lobe &lobe : shared.lobes) alphas.push_back(lobe.alpha);
    Candidate first = per_lobe_candidate(data, options, shared, alphas);
    const double limit = mean_relrmse(check, shared), error = mean_relrmse(check, first.material);
    Candidate *chosen = &first;
    Candidate second;
    std::string choice;
    if (options.refine && error > allowed_worse * limit) {
        second = per_lobe_candidate(data, options, shared, spread_alphas(shared.lobes));
        const double other = mean_relrmse(check, second.material);
        if (other < error) chosen = &second;
        choice = text("from EM's alphas worse on displaced spheres than the shared model (", error, " against ", limit,
                      "); from alphas spread evenly ", other, ": ", other < error ? "kept" : "not kept");
    }
    FitReport &report = chosen->material.report;
    report.displaced_relrmse_shared = limit;
    report.choice = choice;
    report.seconds += chosen->seconds;
    return std::move(*chosen);
}

// Figures about a material that are not needed to find it.
void judge(const FitData &data, const std::vector<DirectionLevel> &check, Material &m) {
    m.report.base_relrmse = mean_relrmse(data.lit, m);
    m.report.displaced_relrmse = mean_relrmse(check, m);
    if (m.model == Model::Shared) m.report.displaced_relrmse_shared = m.report.displaced_relrmse;
}

void describe(const FitData &data, const FitOptions &options, Candidate &candidate) {
    FitReport &report = candidate.material.report;
    if (options.refine && options.model == Model::PerLobe)
        report.deviations = deviations(candidate.curves.levels, candidate.curves.fit, data.scale);
    for (double degrees : DirectionalAlbedo::theta_o_degrees)
        report.albedo.theta_o.push_back(degrees * std::numbers::pi / 180);
    report.albedo.table = data.albedo.of_table();
    report.albedo.fit = data.albedo.of(candidate.material);
}

// A table as its fits need it.
struct Table {
    FitData data;
    std::vector<DirectionLevel> check;
};

// With a number of lobes; `table` null: a density without one.
Candidate fit_with(const Table *table, const SlopeDensity &density, unsigned lobes, const FitOptions &options) {
    Lap lap;
    Candidate candidate{fit_mixture(density, lobes, options), {}, 0.0};
    candidate.material.report.seconds = lap.read();
    if (!table) return candidate;
    if (options.model == Model::PerLobe)
        candidate = make_per_lobe(table->data, table->check, options, candidate.material);
    judge(table->data, table->check, candidate.material);
    return candidate;
}

Candidate fit_automatically(const Table *table, const SlopeDensity &density, const FitOptions &options) {
    Candidate chosen = fit_with(table, density, 1, options);
    for (unsigned lobes = 1; lobes < max_lobes; ++lobes) {
        Candidate next = fit_with(table, density, lobes + 1, options);
        FitReport &report = chosen.material.report;
        const double likelihood = next.material.report.log_likelihood - report.log_likelihood;
        const double relrmse = report.displaced_relrmse - next.material.report.displaced_relrmse;
        if (likelihood < auto_likelihood_gain && relrmse < auto_relrmse_gain) {
            report.choice = text(lobes, " lobes: one more lowers the divergence by ", likelihood, " nat",
                                 table ? text(" and the relRMSE on displaced spheres by ", relrmse) : "",
                                 report.choice.empty() ? "" : "; ", report.choice);
            break;
        }
        chosen = std::move(next);
    }
    return chosen;
}

// A table may be brighter than any material's curves go.
void require_curves_in_range(const Material &m) {
    for (const FresnelCurves &set : m.fresnel)
        for (const std::vector<double> &curve : set)
            for (const double value : curve)
                if (value > max_fresnel)
                    fail(Fault::NoSolution, m.name, ": the table is so bright that a Fresnel curve reaches ", value,
                         "; a material's go to ", max_fresnel);
}

Material fit_any(const Table *table, const SlopeDensity &density, const FitOptions &options) {
    Lap lap;
    Candidate fitted = options.lobes == auto_lobes ? fit_automatically(table, density, options)
                                                   : fit_with(table, density, options.lobes, options);
    if (table) describe(table->data, options, fitted);
    fitted.material.report.check_seconds = lap.read() - fitted.material.report.seconds;
    require_curves_in_range(fitted.material);
    validate(fitted.material);
    return std::move(fitted.material);
}

} // namespace

void validate(const FitOptions &o) {
    require(o.model == Model::Shared || o.model == Model::PerLobe, "model is ", static_cast<int>(o.model),
            "; it must be 0 (shared) or 1 (per-lobe)");
    require(o.lobes <= max_lobes, "lobes is ", o.lobes, "; it must be 1..", max_lobes, ", or 0 for automatic");
    require(o.tolerance > 0.0 && std::isfinite(o.tolerance), "tolerance is ", o.tolerance, "; it must be above 0");
    require(o.max_iterations >= 1 && o.max_iterations <= 1000000, "max_iterations is ", o.max_iterations,
            "; it must be 1..1000000");
}

Material fit_material(const Brdf &brdf, const SlopeDensity &density, const FitOptions &options) {
    validate(options);
    Lap lap;
    FitData data(brdf);
    const double data_seconds = lap.read();
    const Table table = {std::move(data), displaced_check(brdf)};
    const double check_seconds = lap.read();
    Material m = fit_any(&table, density, options);
    if (options.model == Model::PerLobe) m.report.seconds += data_seconds;
    m.report.check_seconds += check_seconds;
    return m;
}

Material fit_material(const SlopeDensity &density, const FitOptions &options) {
    validate(options);
    require(options.model == Model::Shared, "model is 1 (per-lobe), but the density ", density.source,
            " has no BRDF to fit its curves to; it must be 0 (shared)");
    return fit_any(nullptr, density, options);
}

} // namespace smx
