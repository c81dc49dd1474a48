// Filtered shading: by model and number of lobes beside the scalar loop and the kernel of built-in functions, and by
// the widening's order beside the closed form.
#include "bench_job.h"
#include "renderings.h"
#include "shading.h"

namespace slopemix::cli {

namespace {

constexpr int runs_per_round = 5; // of a few milliseconds each

Rendering shade(BenchJob &job, const Material &material, smx_grade grade, int order = 0) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.grade = grade;
    options.widening_order = order;
    job.progress.attach(options);
    return render_filtered(job.context, material, shading_scene(), options);
}

void add_runs(Times &times, BenchJob &job, const Material &material, smx_grade grade, int order = 0) {
    for (int run = 0; run < runs_per_round; ++run) times.add(shade(job, material, grade, order).report);
}

// Another formula would be another time.
void require_same_picture(const char *baseline, const ShadingResult &result, const Image &wanted) {
    const Image picture = acquire<Image>(smx_image_create, std::uint32_t{shading_side}, std::uint32_t{shading_side},
                                         static_cast<const float *>(result.rgba.data()));
    smx_comparison comparison = SMX_COMPARISON_INIT;
    check(smx_image_compare(picture.get(), wanted.get(), &comparison));
    constexpr double float_formulas = 1e-3; // what the baselines' plain formulas lose in floats
    if (!(comparison.relrmse < float_formulas))
        throw CommandError(std::string(baseline) + " shades another picture: relRMSE " +
                           std::to_string(comparison.relrmse));
}

std::string name_of(bool per_lobe, int count) {
    return std::string("shade.") + (per_lobe ? "per-lobe" : "shared") + ".n" + std::to_string(count);
}

void bench_lobes(BenchJob &job, ShadingBuiltin &builtin, bool per_lobe, int count) {
    const ShadingCase what = shading_case(per_lobe, count);
    const Material material = acquire<Material>([&](smx_material *made) { return make_material(what, made); });
    const Rendering first = shade(job, material, SMX_GRADE_PRECISE);
    const auto evaluations = static_cast<double>(first.report.evaluations);
    require_same_picture("scalar-one-core", shade_scalar(what), first.image);
    require_same_picture("builtin-kernel", builtin.shade(what), first.image);
    shade(job, material, SMX_GRADE_FAST); // compiles

    Times precise, fast, scalar, plain;
    for (int round = 0; round < job.rounds; ++round) {
        add_runs(precise, job, material, SMX_GRADE_PRECISE);
        add_runs(fast, job, material, SMX_GRADE_FAST);
        scalar.add(shade_scalar(what).seconds, evaluations);
        plain.add(builtin.shade(what).seconds, evaluations);
    }
    for (const smx_grade grade : bench_grades) {
        const double ns = (grade == SMX_GRADE_FAST ? fast : precise).median();
        job.rows.push_back({name_of(per_lobe, count), grade, ns, "scalar-one-core", scalar.median()});
        job.rows.push_back({name_of(per_lobe, count), grade, ns, "builtin-kernel", plain.median()});
    }
}

void bench_orders(BenchJob &job, smx_grade grade) {
    constexpr int count = 8;
    const ShadingCase what = shading_case(true, count);
    const Material material = acquire<Material>([&](smx_material *made) { return make_material(what, made); });
    for (const int order : widening_orders) {
        shade(job, material, grade, order); // compiles
        Times widened, closed;
        for (int round = 0; round < job.rounds; ++round) {
            widened.add(shade(job, material, grade, order).report);
            add_runs(closed, job, material, grade);
        }
        job.rows.push_back({name_of(true, count) + ".order" + std::to_string(order), grade, widened.median(),
                            "closed-form", closed.median()});
    }
}

} // namespace

void bench_shading(BenchJob &job) {
    ShadingBuiltin builtin(info_of(job.context).index);
    for (const bool per_lobe : {false, true})
        for (const int count : lobe_counts) {
            job.progress.start(name_of(per_lobe, count), 1.0);
            bench_lobes(job, builtin, per_lobe, count);
            job.progress.finish();
        }
}

void bench_widening(BenchJob &job) {
    for (const smx_grade grade : bench_grades) {
        job.progress.start("orders of widening", 1.0);
        bench_orders(job, grade);
        job.progress.finish();
    }
}

} // namespace slopemix::cli
