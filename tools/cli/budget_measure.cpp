// Renders what a budget compares: references of the measured table, of the inverted density's table and of both fits'
// tables, and the filtered fits.
#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "budget_job.h"
#include "input.h"
#include "progress.h"
#include "renderings.h"
#include "text.h"

namespace slopemix::cli {

namespace {

double relrmse(const Image &image, const Image &reference) {
    smx_comparison comparison = SMX_COMPARISON_INIT;
    check(smx_image_compare(image.get(), reference.get(), &comparison));
    return comparison.relrmse;
}

// A fitted material, and the table of it without displacement.
struct Base {
    smx_model model;
    Material material;
    Brdf table;
};

class Budget {
  public:
    explicit Budget(const BudgetJob &job)
        : job_(job), progress_(references_per_view * static_cast<double>(job.alphas.size() * job.lights.size())) {
        context_ = open_context(job.flags);
        measured_ = open_brdf(job.input);
        result_.device = info_of(context_).name;
        result_.material = info_of(measured_);
    }

    BudgetResult measure() {
        fit_bases();
        for (std::size_t alpha = 0; alpha < job_.alphas.size(); ++alpha)
            for (std::size_t light = 0; light < job_.lights.size(); ++light) measure_view(alpha, light);
        result_.build_seconds = info_of(context_).build_seconds;
        return std::move(result_);
    }

  private:
    static constexpr double references_per_view = 4.0;

    void fit_bases() {
        progress_.start("inverting " + name_of(job_.input), 0.0);
        const Density density = invert(measured_);
        inverted_ = acquire<Brdf>(smx_density_tabulate, density.get());
        for (std::size_t k = 0; k < bases_.size(); ++k) {
            Base &base = bases_[k];
            base.model = models[k].value;
            progress_.start(std::string("fitting, ") + models[k].word, 0.0);
            FitFlags flags;
            flags.model = base.model;
            flags.lobes = job_.lobes;
            base.material = fit(density, flags);
            base.table = acquire<Brdf>(smx_material_tabulate, base.material.get());
        }
    }

    void measure_view(std::size_t alpha, std::size_t light) {
        const auto [alpha_x, alpha_y] = job_.alphas[alpha];
        const double degrees = job_.lights[light];
        const smx_scene view = scene(job_.flags, {alpha_x, alpha_y, 0.0, 0.0, 0.0}, degrees);
        label_ = general(alpha_x, 4) + ',' + general(alpha_y, 4) + " under " + general(degrees, 4) + " degrees: ";

        const Image wanted = reference("measured", measured_, view);
        const double inversion = relrmse(reference("inverted", inverted_, view), wanted);
        for (const Base &base : bases_) {
            const Image unwidened = reference(word_for(base.model, models), base.table, view);
            const Image filtered = render_filtered(context_, base.material, view, options()).image;
            BudgetErrors errors;
            if (base.model == SMX_MODEL_SHARED) errors.inversion = inversion;
            errors.fit = relrmse(unwidened, wanted);
            errors.widening = relrmse(filtered, unwidened);
            errors.total = relrmse(filtered, wanted);
            result_.entries.push_back({alpha, light, base.model, errors});
        }
    }

    Image reference(const std::string &what, const Brdf &table, const smx_scene &view) {
        progress_.start(label_ + what, 1.0);
        Rendering rendering = render_reference(context_, table, view, options());
        progress_.finish();
        const double error = rendering.report.standard_error;
        if (error >= 0.0) result_.standard_error = std::max(error, result_.standard_error.value_or(0.0));
        return std::move(rendering.image);
    }

    smx_render_options options() {
        smx_render_options options = render_options(job_.flags);
        progress_.attach(options);
        return options;
    }

    const BudgetJob &job_;
    Progress progress_;
    std::string label_;
    Context context_;
    Brdf measured_, inverted_;
    std::array<Base, std::size(models)> bases_;
    BudgetResult result_;
};

} // namespace

BudgetResult measure_budget(const BudgetJob &job) {
    const auto begin = std::chrono::steady_clock::now();
    BudgetResult result = Budget(job).measure();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

} // namespace slopemix::cli
