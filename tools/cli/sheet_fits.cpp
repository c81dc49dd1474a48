#include "sheet_fits.h"

#include <set>

#include "digest.h"
#include "input.h"

namespace slopemix::cli {

namespace {

SheetFit describe(const Material &material, smx_model model, std::uint32_t lobes, const std::string &sha256) {
    const smx_fit_report report = report_of(material);
    return {model, lobes, info_of(material).lobes, report.log_likelihood, report.residual, report.seconds, sha256};
}

} // namespace

SheetFits::SheetFits(const SheetJob &job, const SheetPlan &plan, const Brdf &brdf) : brdf_(brdf) {
    if (job.fit_files.empty()) return;
    std::vector<Key> keys;
    for (const std::uint32_t lobes : plan.lobes()) keys.emplace_back(SMX_MODEL_SHARED, lobes);
    if (!plan.per_lobe_orders().empty()) keys.emplace_back(SMX_MODEL_PER_LOBE, plan.lobes().back());
    if (job.fit_files.size() != keys.size())
        throw CLI::ValidationError("--fit", "this sheet has " + std::to_string(keys.size()) +
                                                " fits, and a file is needed for each, not " +
                                                std::to_string(job.fit_files.size()));
    for (std::size_t k = 0; k < keys.size(); ++k) files_[keys[k]] = job.fit_files[k];
}

void SheetFits::prepare(const std::vector<SheetImage> &images, Progress &progress) {
    for (const SheetImage &image : images) {
        const Key key = key_of(image);
        if (image.role != Role::filtered || made_.contains(key)) continue;
        const auto file = files_.find(key);
        made_.emplace(key, file == files_.end() ? make(key, progress) : read(key, file->second));
    }
}

SheetFits::Made SheetFits::read(const Key &key, const std::string &file) const {
    const auto [model, lobes] = key;
    Material material = acquire<Material>(smx_material_load, file.c_str());
    const smx_material_info info = info_of(material);
    if (std::string(info.sha256) != info_of(brdf_).sha256)
        throw CommandError(file + " is no fit of this table: its source has the sha256 '" + info.sha256 +
                           "', the table " + info_of(brdf_).sha256);
    if (info.model != model || info.lobes > lobes)
        throw CommandError(file + " is a " + word_for(info.model, models) + " material of " +
                           std::to_string(info.lobes) + " lobes, and its place among --fit is that of " +
                           word_for(model, models) + " and at most " + std::to_string(lobes));
    SheetFit fit = describe(material, model, lobes, sha256_of_file(file));
    return {std::move(material), std::move(fit)};
}

SheetFits::Made SheetFits::make(const Key &key, Progress &progress) {
    const auto [model, lobes] = key;
    progress.start(std::string("fitting, ") + word_for(model, models) + ", N = " + std::to_string(lobes), 0.0);
    if (!density_) density_ = invert(brdf_);
    Material material = fit(density_, {model, lobes});
    SheetFit fit = describe(material, model, lobes, "");
    return {std::move(material), std::move(fit)};
}

std::vector<SheetFit> SheetFits::all() const {
    std::vector<SheetFit> fits;
    for (const auto &[key, made] : made_) fits.push_back(made.fit);
    return fits;
}

} // namespace slopemix::cli
