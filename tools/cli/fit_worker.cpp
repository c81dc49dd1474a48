#include "fit_worker.h"

#include "fit_plot.h"
#include "fit_row.h"
#include "output.h"
#include "plot.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

std::vector<smx_lobe> lobes_of(const Material &material) {
    std::vector<smx_lobe> lobes(info_of(material).lobes);
    check(smx_material_get_lobes(material.get(), lobes.data(), lobes.size()));
    return lobes;
}

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

FitWorker::FitWorker(const FitJob &job, const FitTable &earlier)
    : job_(job), earlier_(earlier), options_(options_text(job.fit)) {
    if (!job.plot) return;
    require_gnuplot();
    context_ = open_context("");
}

Material FitWorker::load_if_up_to_date(const std::string &input, const Brdf &brdf) const {
    const std::string sha256 = info_of(brdf).sha256;
    const FitTable::Row *row = job_.refit ? nullptr : earlier_.find(name_of(input));
    if (!row || !is_row_of(*row, sha256, options_)) return nullptr;
    smx_material material = nullptr;
    if (smx_material_load(job_.file_for(input).c_str(), &material) != SMX_OK) return nullptr;
    Material loaded(material);
    return info_of(loaded).sha256 == sha256 && info_of(loaded).model == job_.fit.model ? std::move(loaded) : nullptr;
}

Fitted FitWorker::describe(const std::string &input, const Material &material, bool up_to_date) const {
    const smx_material_info info = info_of(material);
    return {input,
            name_of(input),
            job_.file_for(input).string(),
            options_,
            info.sha256,
            info.model,
            lobes_of(material),
            f0_of(material),
            report_of(material),
            up_to_date};
}

void FitWorker::fit_input(const std::string &input, FitOutcome &outcome) const {
    const Brdf brdf = open_brdf(input);
    const fs::path file = job_.file_for(input);
    Density density;
    Material material = load_if_up_to_date(input, brdf);
    const bool up_to_date = material != nullptr;
    if (!up_to_date) {
        density = invert(brdf);
        material = fit(density, job_.fit);
        make_folder_of(file);
        check(smx_material_save(material.get(), file.c_str()));
    }
    outcome.fitted = describe(input, material, up_to_date);

    if (!job_.plot || (up_to_date && !is_stale(job_.plot_for(input), file))) return;
    if (!density) density = invert(brdf);
    const std::string svg = plot_fit(context_, brdf, density, material, job_.fit);
    StagedFiles files;
    files.write(job_.plot_for(input), [&](const fs::path &temporary) { write_text(temporary, svg); });
    files.commit();
}

FitOutcome FitWorker::process(std::size_t index) const {
    FitOutcome outcome{index, {}, {}};
    try {
        fit_input(job_.inputs[index], outcome);
    } catch (const Cancelled &) {
        if (!outcome.fitted) throw;
    } catch (const CommandError &error) {
        outcome.error = error.what();
    }
    return outcome;
}

} // namespace slopemix::cli
