// The reference: by table and sampler, beside the plain kernel and the scalar loop.
#include <cmath>

#include "bench_job.h"
#include "reference.h"
#include "renderings.h"

namespace slopemix::cli {

namespace {

constexpr std::uint32_t samples = 4096; // the library's per pixel

struct ReferenceCase {
    const char *name;
    smx_sampler sampler;
    int whole_table;
};

constexpr ReferenceCase cases[] = {{"reference.slice.grid", SMX_SAMPLER_GRID, 0},
                                   {"reference.slice.sobol", SMX_SAMPLER_SOBOL, 0},
                                   {"reference.slice.mis", SMX_SAMPLER_MIS, 0},
                                   {"reference.full.grid", SMX_SAMPLER_GRID, 1},
                                   {"reference.full.mis", SMX_SAMPLER_MIS, 1}};
static_assert(std::size(cases) == static_cast<std::size_t>(reference_jobs));

Rendering integrate(BenchJob &job, const Brdf &brdf, const ReferenceCase &what, smx_grade grade) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.sampler = what.sampler;
    options.whole_table = what.whole_table;
    options.spp = samples;
    options.grade = grade;
    job.progress.attach(options);
    return render_reference(job.context, brdf, reference_scene(), options);
}

double mean_green(const Image &image) {
    double sum = 0.0;
    for (int k = 0; k < reference_side * reference_side; ++k)
        sum += static_cast<double>(smx_image_pixels(image.get())[4 * k + 1]);
    return sum / (reference_side * reference_side);
}

// Another integral would be another time.
void require_same_mean(const char *baseline, const PlainResult &result, double wanted) {
    constexpr double noise = 0.05; // several times that of the baselines' samples
    if (!(std::abs(result.mean_green / wanted - 1.0) < noise))
        throw CommandError(std::string(baseline) + " integrates to another mean: " + std::to_string(result.mean_green) +
                           ", not " + std::to_string(wanted));
}

void bench_case(BenchJob &job, const Brdf &brdf, const std::vector<float> &table, ReferencePlain &plain_kernel,
                const ReferenceCase &what) {
    const Rendering first = integrate(job, brdf, what, SMX_GRADE_PRECISE);
    const double mean = mean_green(first.image);
    const double evaluations = static_cast<double>(first.report.evaluations) / samples * plain_samples;
    std::uint32_t seed = 1;
    require_same_mean("scalar-one-core", reference_scalar(table, seed), mean);
    require_same_mean("plain-kernel", plain_kernel.integrate(seed), mean);
    integrate(job, brdf, what, SMX_GRADE_FAST); // compiles

    Times precise, fast, scalar, plain;
    for (int round = 0; round < job.rounds; ++round) {
        precise.add(integrate(job, brdf, what, SMX_GRADE_PRECISE).report);
        fast.add(integrate(job, brdf, what, SMX_GRADE_FAST).report);
        scalar.add(reference_scalar(table, ++seed).seconds, evaluations);
        plain.add(plain_kernel.integrate(seed).seconds, evaluations);
    }
    for (const smx_grade grade : bench_grades) {
        const double ns = (grade == SMX_GRADE_FAST ? fast : precise).median();
        job.rows.push_back({what.name, grade, ns, "plain-kernel", plain.median()});
        job.rows.push_back({what.name, grade, ns, "scalar-one-core", scalar.median()});
    }
}

} // namespace

void bench_reference(BenchJob &job) {
    const Brdf brdf = acquire<Brdf>(smx_brdf_open, "builtin:two-layer");
    std::vector<float> table;
    check(plain_table(brdf.get(), &table));
    ReferencePlain plain_kernel(info_of(job.context).index, table);
    for (const ReferenceCase &what : cases) {
        job.progress.start(what.name, 1.0);
        bench_case(job, brdf, table, plain_kernel, what);
        job.progress.finish();
    }
}

} // namespace slopemix::cli
