// Renders the images of a sheet, measures the filtered ones against their references, and gathers what the exposures
// need. One reference is in memory at a time.
#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "existing_reference.h"
#include "exposure.h"
#include "input.h"
#include "progress.h"
#include "renderings.h"
#include "sheet_job.h"

namespace slopemix::cli {

namespace {

class SheetRenderer {
  public:
    SheetRenderer(const SheetJob &job, const SheetPlan &plan, StagedFiles &files)
        : job_(job), steps_(plan.steps()), files_(files), progress_(total_work()) {
        context_ = open_context(job.flags);
        brdf_ = open_brdf(job.input);
        result_.device = info_of(context_).name;
        result_.material = info_of(brdf_);
    }

    SheetResult render() {
        fit_materials();
        for (const SheetStep &step : steps_) {
            progress_.start(label(step.image), work(step.image));
            process(step);
            progress_.finish();
        }
        std::sort(result_.entries.begin(), result_.entries.end(),
                  [](const SheetEntry &a, const SheetEntry &b) { return a.image.id < b.image.id; });
        result_.build_seconds = info_of(context_).build_seconds;
        return std::move(result_);
    }

  private:
    // Proportional to the evaluations per pixel, so that the bar moves evenly.
    double work(const SheetImage &image) const { return image.role == Role::reference ? job_.flags.spp : 1.0; }

    double total_work() const {
        double total = 0.0;
        for (const SheetStep &step : steps_) total += work(step.image);
        return total;
    }

    static std::string label(const SheetImage &image) {
        const char *const role[] = {"geometry", "reference", "filtered"};
        return to_string(image.id) + ' ' + role[static_cast<std::size_t>(image.role)];
    }

    // The inversion is done once for all numbers of lobes, and only if a filtered image is wanted.
    void fit_materials() {
        Density density;
        for (const SheetStep &step : steps_) {
            const FitFlags flags = {step.image.model, step.image.lobes};
            if (step.image.role != Role::filtered || materials_.contains(key_of(step.image))) continue;
            progress_.start(
                std::string("fitting, ") + word_for(flags.model, models) + ", N = " + std::to_string(flags.lobes), 0.0);
            if (!density) density = invert(brdf_);
            const Material &material = materials_[key_of(step.image)] = fit(density, flags);
            result_.fits.push_back({flags.model, flags.lobes, report_of(material)});
        }
    }

    void process(const SheetStep &step) {
        switch (step.image.role) {
            case Role::geometry:
                return process_geometry(step);
            case Role::reference:
                return process_reference(step);
            case Role::filtered:
                return process_filtered(step);
        }
    }

    void process_geometry(const SheetStep &step) {
        const Rendering rendering = render_geometry(context_, scene_of(step.image), options());
        result_.geometry_bright = std::max(result_.geometry_bright, bright_value(rendering.image));
        keep(step.image, rendering);
    }

    void process_reference(const SheetStep &step) {
        const smx_scene scene = scene_of(step.image);
        if (step.is_output)
            reference_.reset();
        else // one that an earlier sheet left in the folder
            reference_ = existing_reference(job_.image_file(step.image.id), result_.material.sha256, scene, options());
        if (!reference_) {
            Rendering rendering = render_reference(context_, brdf_, scene, options());
            result_.reference_seconds += rendering.report.seconds - rendering.report.build_seconds;
            result_.reference_samples += rendering.report.evaluations;
            if (step.is_output) keep(step.image, rendering);
            reference_ = std::move(rendering.image);
        }
        double &bright = result_.light_bright[step.image.light];
        bright = std::max(bright, bright_value(reference_));
    }

    void process_filtered(const SheetStep &step) {
        const Material &material = materials_.at(key_of(step.image));
        smx_render_options how = options();
        how.widening_order = step.image.widening_order;
        const Rendering rendering = render_filtered(context_, material, scene_of(step.image), how);
        smx_comparison errors = SMX_COMPARISON_INIT;
        check(smx_image_compare(rendering.image.get(), reference_.get(), &errors));
        keep(step.image, rendering, errors);
    }

    void keep(const SheetImage &image, const Rendering &rendering, std::optional<smx_comparison> errors = {}) {
        const std::filesystem::path file = files_.write(job_.image_file(image.id), [&](const auto &temporary) {
            check(smx_image_write_exr(rendering.image.get(), temporary.c_str()));
        });
        result_.entries.push_back({image, file, rendering.report, errors});
    }

    smx_scene scene_of(const SheetImage &image) const {
        const smx_displacement displacement = {image.alpha_x, image.alpha_y, 0.0, 0.0, 0.0};
        return scene(job_.flags, displacement, image.has_light() ? light_degrees[image.light] : light_degrees[0]);
    }

    smx_render_options options() {
        smx_render_options options = render_options(job_.flags);
        progress_.attach(options);
        return options;
    }

    const SheetJob &job_;
    const std::vector<SheetStep> steps_;
    StagedFiles &files_;
    Progress progress_;
    Context context_;
    Brdf brdf_;
    using FitKey = std::pair<smx_model, std::uint32_t>;
    static FitKey key_of(const SheetImage &image) { return {image.model, image.lobes}; }

    std::map<FitKey, Material> materials_; // by the number of lobes asked for
    Image reference_;                      // of the row and light at hand
    SheetResult result_;
};

} // namespace

SheetResult render_sheet(const SheetJob &job, const SheetPlan &plan, StagedFiles &files) {
    return SheetRenderer(job, plan, files).render();
}

} // namespace slopemix::cli
