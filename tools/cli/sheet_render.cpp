// Renders the images of a sheet that no earlier run has finished, measures the filtered ones against their references,
// and gathers what the exposures need. One reference is in memory at a time.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "existing_reference.h"
#include "exposure.h"
#include "input.h"
#include "progress.h"
#include "renderings.h"
#include "sheet_job.h"
#include "sheet_journal.h"

namespace slopemix::cli {

namespace {

// The steps without those of kept images. A reference that is kept stays, for comparison only, where a filtered image
// is still to come, and one that is there for nothing else goes where none is.
std::vector<SheetStep> remaining(const std::vector<SheetStep> &steps, const std::set<ImageId> &kept) {
    std::vector<SheetStep> left;
    std::optional<SheetStep> only_compared;
    for (const SheetStep &step : steps) {
        const bool is_left = step.is_output && !kept.contains(step.image.id);
        if (step.image.role == Role::reference) {
            only_compared.reset();
            if (!is_left) only_compared = {step.image, false};
        }
        if (!is_left) continue;
        if (step.image.role == Role::filtered && only_compared) left.push_back(*std::exchange(only_compared, {}));
        left.push_back(step);
    }
    return left;
}

class SheetRenderer {
  public:
    SheetRenderer(const SheetJob &job, const SheetPlan &plan, SheetJournal &journal)
        : job_(job), plan_(plan), steps_(plan.steps()), journal_(journal), progress_(total_work()) {
        context_ = open_context(job.flags);
        brdf_ = open_brdf(job.input);
        result_.device = info_of(context_).name;
        result_.material = info_of(brdf_);
        journal_.open(result_);
        for (const SheetEntry &entry : result_.entries) {
            kept_.insert(entry.image.id);
            note_bright(entry);
        }
    }

    SheetResult render() {
        if (journal_.is_complete()) return std::move(result_);
        for (const ImageId &id : kept_) progress_.advance(to_string(id) + " is there", work(plan_.image(id)));
        fit_materials();
        for (const SheetStep &step : remaining(steps_, kept_)) {
            progress_.start(label(step.image), kept_.contains(step.image.id) ? 0.0 : work(step.image));
            process(step);
            progress_.finish();
        }
        std::sort(result_.entries.begin(), result_.entries.end(),
                  [](const SheetEntry &a, const SheetEntry &b) { return a.image.id < b.image.id; });
        note_times();
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
        keep(step.image, rendering, bright_value(rendering.image));
    }

    void process_reference(const SheetStep &step) {
        const smx_scene scene = scene_of(step.image);
        reference_.reset();
        if (kept_.contains(step.image.id))
            reference_ = acquire<Image>(smx_image_read_exr, job_.image_file(step.image.id).c_str());
        else if (!step.is_output) // one that an earlier sheet left in the folder
            reference_ = existing_reference(job_.image_file(step.image.id), result_.material.sha256, scene, options());
        if (!reference_) {
            Rendering rendering = render_reference(context_, brdf_, scene, options());
            result_.reference_seconds += rendering.report.seconds - rendering.report.build_seconds;
            result_.reference_samples += rendering.report.evaluations;
            reference_bright_ = bright_value(rendering.image);
            if (step.is_output) keep(step.image, rendering, reference_bright_);
            reference_ = std::move(rendering.image);
        } else {
            reference_bright_ = bright_value(reference_);
        }
    }

    void process_filtered(const SheetStep &step) {
        const Material &material = materials_.at(key_of(step.image));
        smx_render_options how = options();
        how.widening_order = step.image.widening_order;
        const Rendering rendering = render_filtered(context_, material, scene_of(step.image), how);
        smx_comparison errors = SMX_COMPARISON_INIT;
        check(smx_image_compare(rendering.image.get(), reference_.get(), &errors));
        keep(step.image, rendering, reference_bright_, errors);
    }

    void keep(const SheetImage &image, const Rendering &rendering, double bright,
              std::optional<smx_comparison> errors = {}) {
        note_times();
        journal_.keep({image, job_.image_file(image.id), rendering.report, errors, bright}, rendering.image, result_);
        note_bright(result_.entries.back());
    }

    void note_bright(const SheetEntry &entry) {
        const SheetImage &image = entry.image;
        double &bright = image.has_light() ? result_.light_bright[image.light] : result_.geometry_bright;
        bright = std::max(bright, entry.bright);
    }

    void note_times() {
        using Seconds = std::chrono::duration<double>;
        result_.total_seconds = result_.earlier_seconds + Seconds(std::chrono::steady_clock::now() - begin_).count();
        result_.build_seconds = result_.earlier_build_seconds + info_of(context_).build_seconds;
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

    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    const SheetJob &job_;
    const SheetPlan &plan_;
    const std::vector<SheetStep> steps_;
    SheetJournal &journal_;
    Progress progress_;
    Context context_;
    Brdf brdf_;
    using FitKey = std::pair<smx_model, std::uint32_t>;
    static FitKey key_of(const SheetImage &image) { return {image.model, image.lobes}; }

    std::map<FitKey, Material> materials_; // by the number of lobes asked for
    Image reference_;                      // of the row and light at hand
    double reference_bright_ = 0.0;
    std::set<ImageId> kept_; // finished by an earlier run
    SheetResult result_;
};

} // namespace

SheetResult render_sheet(const SheetJob &job, const SheetPlan &plan, SheetJournal &journal) {
    return SheetRenderer(job, plan, journal).render();
}

} // namespace slopemix::cli
