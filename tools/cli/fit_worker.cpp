#include "fit_worker.h"

#include "fit_plot.h"
#include "fit_row.h"
#include "output.h"
#include "plot.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

std::array<double, 3> f0_of(const Material &material) {
    const smx_material_info info = info_of(material);
    std::vector<double> curves(std::size_t{3} * info.fresnel_sets * info.fresnel_knots);
    check(smx_material_get_fresnel(material.get(), nullptr, curves.data(), curves.size()));
    std::array<double, 3> f0 = {};
    for (std::size_t k = 0; k < std::size_t{3} * info.fresnel_sets; ++k) f0[k % 3] += curves[k * info.fresnel_knots];
    return f0;
}

// The picture is missing, or older than the material that it shows.
bool is_stale(const fs::path &plot, const fs::path &material) {
    std::error_code ignored;
    return !fs::exists(plot, ignored) || fs::last_write_time(plot, ignored) < fs::last_write_time(material, ignored);
}

} // namespace

FitWorker::FitWorker(const FitJob &job, const FitTable &earlier) : job_(job), earlier_(earlier) {
    if (job.plot) context_ = open_context({});
}

std::optional<double> FitWorker::build_seconds() const {
    if (!context_) return std::nullopt;
    return info_of(context_).build_seconds;
}

Material FitWorker::load_if_up_to_date(const FitSource &source) const {
    const std::string sha256 = source.sha256();
    const FitTable::Row *row = job_.refit ? nullptr : earlier_.find(name_of(source.input()));
    if (!row || !is_row_of(*row, sha256, options_text(source.flags()))) return nullptr;
    smx_material material = nullptr;
    if (smx_material_load(job_.file_for(source.input()).c_str(), &material) != SMX_OK) return nullptr;
    Material loaded(material);
    const smx_material_info info = info_of(loaded);
    if (info.sha256 != sha256 || info.model != source.flags().model) return nullptr;
    // A run that was killed between the file and its row leaves a file of other options.
    return is_row_of_lobes(*row, lobes_of(loaded)) ? std::move(loaded) : nullptr;
}

Fitted FitWorker::describe(const FitSource &source, const Material &material, bool up_to_date) const {
    const smx_material_info info = info_of(material);
    return {source.input(),
            name_of(source.input()),
            job_.file_for(source.input()).string(),
            options_text(source.flags()),
            info.sha256,
            info.model,
            lobes_of(material),
            f0_of(material),
            report_of(material),
            up_to_date,
            up_to_date ? metrics_of(*earlier_.find(name_of(source.input()))) : std::nullopt};
}

void FitWorker::draw(FitSource &source, const Material &material) const {
    const std::string svg =
        source.brdf() ? plot_fit(context_, source, material) : plot_density(source.density(), material);
    StagedFiles files;
    files.write(job_.plot_for(source.input()), [&](const fs::path &temporary) { write_text(temporary, svg); });
    files.commit();
}

void FitWorker::fit_input(const std::string &input, FitOutcome &outcome) const {
    FitSource source(input, job_.fit);
    const fs::path file = job_.file_for(input);
    Material material = load_if_up_to_date(source);
    const bool up_to_date = material != nullptr;
    if (!up_to_date) {
        material = fit(source.density(), source.flags());
        StagedFiles files;
        files.write(file,
                    [&](const fs::path &temporary) { check(smx_material_save(material.get(), temporary.c_str())); });
        files.commit();
    }
    Fitted &fitted = outcome.fitted.emplace(describe(source, material, up_to_date));
    if (job_.metrics && !fitted.metrics && source.brdf()) fitted.metrics = measure_fit(source, material);
    if (job_.plot && (!up_to_date || is_stale(job_.plot_for(input), file))) draw(source, material);
}

FitOutcome FitWorker::process(std::size_t index) const {
    FitOutcome outcome{index, {}, {}, false};
    try {
        fit_input(job_.inputs[index], outcome);
    } catch (const Cancelled &) {
        if (!outcome.fitted) throw;
        outcome.cancelled = true;
    } catch (const CommandError &error) {
        outcome.error = error.what();
    }
    return outcome;
}

} // namespace slopemix::cli
