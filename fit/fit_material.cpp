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

// The per-lobe model from a shared one; in place.
void make_per_lobe(const FitData &data, const std::vector<DirectionLevel> &check, const FitOptions &options,
                   Material &m) {
    Lap lap;
    const Material shared = m;
    std::vector<double> alphas;
    for (const Lobe &lobe : shared.lobes) alphas.push_back(lobe.alpha);
    PerLobeFit fit = fit_per_lobe(data, alphas, options.refine, m);
    m.report.seconds += lap.read();

    m.report.displaced_relrmse_shared = mean_relrmse(check, shared);
    const double allowed = allowed_worse * m.report.displaced_relrmse_shared;
    const double first = mean_relrmse(check, m);
    if (options.refine && first > allowed) {
        Material other = shared;
        const PerLobeFit other_fit = fit_per_lobe(data, spread_alphas(shared.lobes), true, other);
        const double second = mean_relrmse(check, other);
        const bool better = second < first;
        other.report.choice = text("from EM's alphas worse on displaced spheres than the shared model (", first,
                                   " against ", m.report.displaced_relrmse_shared, "); from alphas spread evenly ",
                                   second, ": ", better ? "kept" : "not kept");
        if (better) {
            other.report.seconds = m.report.seconds;
            other.report.displaced_relrmse_shared = m.report.displaced_relrmse_shared;
            m = other;
            fit = other_fit;
        } else {
            m.report.choice = other.report.choice;
        }
    }
    if (options.refine)
        m.report.deviations = deviations(joined(data.base, data.displaced, m.report.displaced_share), fit, data.scale);
    m.report.check_seconds += lap.read();
}

void judge(const FitData &data, const std::vector<DirectionLevel> &check, Material &m) {
    Lap lap;
    m.report.base_relrmse = mean_relrmse(data.lit, m);
    m.report.displaced_relrmse = mean_relrmse(check, m);
    if (m.model == Model::Shared) m.report.displaced_relrmse_shared = m.report.displaced_relrmse;
    for (double degrees : DirectionalAlbedo::theta_o_degrees)
        m.report.albedo.theta_o.push_back(degrees * std::numbers::pi / 180);
    m.report.albedo.table = data.albedo.of_table();
    m.report.albedo.fit = data.albedo.of(m);
    m.report.check_seconds += lap.read();
}

// A table as its fits need it.
struct Table {
    FitData data;
    std::vector<DirectionLevel> check;
};

// With a number of lobes; `table` null: a density without one.
Material fit_with(const Table *table, const SlopeDensity &density, unsigned lobes, const FitOptions &options) {
    Lap lap;
    Material m = fit_mixture(density, lobes, options);
    m.report.seconds = lap.read();
    if (!table) return m;
    if (options.model == Model::PerLobe) make_per_lobe(table->data, table->check, options, m);
    judge(table->data, table->check, m);
    return m;
}

Material fit_automatically(const Table *table, const SlopeDensity &density, const FitOptions &options) {
    Material m = fit_with(table, density, 1, options);
    for (unsigned lobes = 1; lobes < max_lobes; ++lobes) {
        const Material next = fit_with(table, density, lobes + 1, options);
        const double likelihood = next.report.log_likelihood - m.report.log_likelihood;
        const double relrmse = m.report.displaced_relrmse - next.report.displaced_relrmse;
        if (likelihood < auto_likelihood_gain && relrmse < auto_relrmse_gain) {
            m.report.choice = text(lobes, " lobes: one more lowers the divergence by ", likelihood, " nat",
                                   table ? text(" and the relRMSE on displaced spheres by ", relrmse) : "",
                                   m.report.choice.empty() ? "" : "; ", m.report.choice);
            return m;
        }
        m = next;
    }
    return m;
}

Material fit_any(const Table *table, const SlopeDensity &density, const FitOptions &options) {
    Material m = options.lobes == auto_lobes ? fit_automatically(table, density, options)
                                             : fit_with(table, density, options.lobes, options);
    validate(m);
    return m;
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
